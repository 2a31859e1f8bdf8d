//! Whether names are right: kind by kind, against what could be known, and wrong ones.

use serde::Serialize;

use super::equivalence::{can_be_named, names, names_within};
use crate::case::Kind;
use crate::cause::TrueCause;
use crate::claim::Claim;
use crate::diverse::outcome::DiverseOutcome;
use crate::score::Share;
use diagnosis::Value;

/// From here on a cause counts as one that could be known.
pub const KNOWABLE: f64 = 0.9;
/// A cause shows on the logs held out from this share of their gap on.
const SHOWN: f64 = 0.1;
/// A cause with this part of the largest one's share may stand first as well.
const NEARLY_LARGEST: f64 = 0.8;

impl DiverseOutcome {
    /// Whether what a claim names is truly there: as a cause, as a small effect, or, with the sign that
    /// it says, beside them.
    pub fn is_true(&self, claim: &Claim) -> bool {
        let hidden = self.truth.iter().chain(&self.reality.clutter);
        let has_sign = |truth: &TrueCause| {
            truth
                .parameters
                .iter()
                .all(|(name, truth)| is_of_sign(claim.parameters.get(name), truth))
        };
        hidden.into_iter().any(|truth| names(claim, truth))
            || self.beside.iter().any(|truth| names(claim, truth) && has_sign(truth))
    }

    /// Whether a name was given for which there is nothing.
    pub fn has_wrong_name(&self) -> bool {
        self.claims.iter().any(|claim| !self.is_true(claim))
    }

    /// Whether the cause of this place is named.
    pub fn has_named(&self, place: usize) -> bool {
        let truth = self.truth.get(place);
        let is_named = |truth| self.claims.iter().any(|c| names_within(c, truth, &self.truth));
        truth.is_some_and(is_named)
    }

    /// Whether the first name is that of the largest cause, or of one nearly as large; names of
    /// small effects that are there may stand before it.
    pub fn is_first_right(&self) -> bool {
        let share = |place: usize| self.known.get(place).and_then(|known| known.share);
        let least = NEARLY_LARGEST * share(0).unwrap_or_default().max(0.0);
        let large =
            |place: usize| place == 0 || share(place).is_some_and(|s| s > 0.0 && s >= least);
        let is_small = |claim: &&Claim| {
            let names = |truth: &TrueCause| names_within(claim, truth, &self.truth);
            self.is_true(claim) && !self.truth.iter().any(names)
        };
        let Some(first) = self.claims.iter().find(|claim| !is_small(claim)) else { return false };
        let mut places = (0..self.truth.len()).filter(|&place| large(place));
        places.any(|place| names_within(first, &self.truth[place], &self.truth))
    }

    /// Whether the largest cause has a name in the catalogue and could be known.
    pub fn is_knowable(&self) -> bool {
        let has_name = self.truth.first().is_some_and(can_be_named);
        has_name && self.known.first().is_some_and(|known| known.oracle > KNOWABLE)
    }

    /// Whether the largest cause could be known and shows on the logs held out.
    pub fn is_confirmable(&self) -> bool {
        let share = self.known.first().and_then(|known| known.share);
        self.is_knowable() && share.is_some_and(|share| share >= SHOWN)
    }

    /// Whether the largest cause, one that the catalogue has, could be known and, told with its values, shows on the logs held
    /// out by the report's own measure.
    pub fn is_measurable(&self) -> bool {
        let share = self.told_shares.first().copied().flatten();
        self.is_knowable() && share.is_some_and(|share| share >= SHOWN)
    }

    /// Whether the largest cause alone is more than half of the gap.
    pub fn is_dominated(&self) -> bool {
        self.known.first().and_then(|known| known.share).is_some_and(|share| share > 0.5)
    }
}

/// Whether two values are numbers of one sign.
fn is_of_sign(claimed: Option<&Value>, truth: &Value) -> bool {
    match (claimed, truth) {
        (Some(Value::Number(claimed)), Value::Number(truth)) => claimed * truth > 0.0,
        _ => false,
    }
}

/// How many answers are right.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Answers {
    /// Cases with a wrong name, of all.
    pub wrong_name: Share,
    /// Wrong names, of all names.
    pub wrong_claims: Share,
    /// Cases whose largest cause could be known: it stands first.
    pub knowable_first: Share,
    /// The same: it is among the names.
    pub knowable_named: Share,
    /// Those that take a tenth of the gap or more on the logs held out, by twins: it stands first.
    pub confirmable_first: Share,
    /// Those of the catalogue that take as much by the report's own measure, told with their values: it stands first.
    pub measurable_first: Share,
    /// Those of one cause that takes more than half of the gap: it stands first.
    pub dominated_first: Share,
    /// Pairs both of which could be known: both are named.
    pub knowable_pairs: Share,
    /// Largest causes that could not be known, but are named.
    pub beyond_knowable: Share,
    /// Nothing hidden: no name but of small effects that are there.
    pub nothing_right: Share,
    /// Nothing the catalogue has a name for: no wrong name.
    pub nameless_right: Share,
    /// No report.
    pub failed: Share,
}

impl Answers {
    pub(super) fn of(outcomes: &[DiverseOutcome]) -> Self {
        let count = |is_in: &dyn Fn(&DiverseOutcome) -> bool,
                     has: &dyn Fn(&DiverseOutcome) -> bool| {
            let cases = outcomes.iter().filter(|outcome| is_in(outcome));
            cases.fold(Share::default(), |share, outcome| share.with(has(outcome)))
        };
        let claims = outcomes.iter().flat_map(|o| o.claims.iter().map(move |c| !o.is_true(c)));
        let nameable = |o: &DiverseOutcome| o.truth.first().is_some_and(can_be_named);
        let both_knowable = |o: &DiverseOutcome| {
            o.kind == Kind::Pair
                && o.truth.iter().all(can_be_named)
                && o.known.iter().all(|known| known.oracle > KNOWABLE)
        };
        let right = |o: &DiverseOutcome| !o.has_wrong_name();
        Self {
            wrong_name: count(&|_| true, &DiverseOutcome::has_wrong_name),
            wrong_claims: claims.fold(Share::default(), Share::with),
            knowable_first: count(&DiverseOutcome::is_knowable, &DiverseOutcome::is_first_right),
            knowable_named: count(&DiverseOutcome::is_knowable, &|o| o.has_named(0)),
            confirmable_first: count(
                &DiverseOutcome::is_confirmable,
                &DiverseOutcome::is_first_right,
            ),
            measurable_first: count(
                &DiverseOutcome::is_measurable,
                &DiverseOutcome::is_first_right,
            ),
            dominated_first: count(
                &|o| o.truth.len() == 1 && nameable(o) && o.is_dominated(),
                &DiverseOutcome::is_first_right,
            ),
            knowable_pairs: count(&both_knowable, &|o| o.has_named(0) && o.has_named(1)),
            beyond_knowable: count(&|o| nameable(o) && !o.is_knowable(), &|o| o.has_named(0)),
            nothing_right: count(&|o| o.kind == Kind::None, &right),
            nameless_right: count(&|o| !o.truth.is_empty() && !nameable(o), &right),
            failed: count(&|_| true, &|o| o.failure.is_some()),
        }
    }
}
