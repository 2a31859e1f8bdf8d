//! Which truths are taken for which.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::case::Kind;
use crate::foreign;
use crate::outcome::Outcome;
use rig::effects::Catalogue;

/// A row of the confusion matrix: the truth, and what was named first.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct ConfusionRow {
    /// The true effect, or "none".
    pub truth: String,
    /// Whether the catalogue does not have it.
    pub foreign: bool,
    /// How many cases.
    pub cases: usize,
    /// How often the first cause is the true effect; for "none" and foreign effects, how
    /// often the answer is "none" or "unknown".
    pub right: usize,
    /// How often each effect, "none", "unknown" or "failed" was the answer.
    pub answers: BTreeMap<String, usize>,
}

/// Rows in the order of the catalogue; truths that did not occur have none.
pub(super) fn rows(outcomes: &[Outcome], catalogue: &Catalogue) -> Vec<ConfusionRow> {
    let known = catalogue.iter().map(|definition| (definition.name, Kind::Single));
    let foreign = foreign::ALL.iter().map(|definition| (definition.name, Kind::Foreign));
    let truths = std::iter::once(("none", Kind::None)).chain(known).chain(foreign);
    truths.filter_map(|(name, kind)| row(outcomes, name, kind)).collect()
}

fn row(outcomes: &[Outcome], name: &str, kind: Kind) -> Option<ConfusionRow> {
    let truth = |outcome: &Outcome| match &outcome.truth[..] {
        [] => "none".to_owned(),
        [single, ..] => single.effect.clone(),
    };
    let is_wanted = |outcome: &&Outcome| outcome.kind == kind && truth(outcome) == name;
    let right = if kind == Kind::Foreign { "unknown" } else { name };
    let mut answers = BTreeMap::new();
    for outcome in outcomes.iter().filter(is_wanted) {
        *answers.entry(outcome.answer.label().to_owned()).or_default() += 1;
    }
    (!answers.is_empty()).then(|| ConfusionRow {
        truth: name.to_owned(),
        foreign: kind == Kind::Foreign,
        cases: answers.values().sum(),
        right: answers.get(right).copied().unwrap_or_default(),
        answers,
    })
}
