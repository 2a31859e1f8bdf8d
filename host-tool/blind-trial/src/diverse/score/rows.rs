//! The same counts, divided by what the robot is.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::diverse::outcome::DiverseOutcome;
use crate::score::Share;

/// Cases that have something in common.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// What they have in common.
    pub what: String,
    /// Of those whose largest cause could be known: it stands first.
    pub knowable_first: Share,
    /// Of all: a wrong name was given.
    pub wrong_name: Share,
    /// How often each verdict was given.
    pub verdicts: BTreeMap<String, usize>,
}

/// What diagnoses took [s].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Times {
    /// Mean of the time on the wall.
    pub mean_seconds: f64,
    /// Mean of the processor's time.
    pub mean_processor_seconds: f64,
    /// The longest processor's time.
    pub most_processor_seconds: f64,
}

impl Times {
    pub(super) fn of(outcomes: &[DiverseOutcome]) -> Self {
        let count = outcomes.len().max(1) as f64;
        let processor = outcomes.iter().map(|outcome| outcome.processor_seconds);
        Self {
            mean_seconds: outcomes.iter().map(|outcome| outcome.seconds).sum::<f64>() / count,
            mean_processor_seconds: processor.clone().sum::<f64>() / count,
            most_processor_seconds: processor.fold(0.0, f64::max),
        }
    }
}

pub(super) fn by_friction(outcomes: &[DiverseOutcome]) -> Vec<Row> {
    rows(outcomes, |outcome| {
        let friction = outcome.reality.friction[0];
        let warm = if friction.heat.is_some() { ", warming" } else { "" };
        format!("{}{warm}", friction.law.name())
    })
}

pub(super) fn by_cause(outcomes: &[DiverseOutcome]) -> Vec<Row> {
    rows(outcomes, |outcome| match outcome.truth.first() {
        None => "none".to_owned(),
        Some(truth) if truth.is_foreign() => format!("foreign: {}", truth.effect),
        Some(truth) => truth.effect.clone(),
    })
}

pub(super) fn by_share(outcomes: &[DiverseOutcome]) -> Vec<Row> {
    rows(outcomes, |outcome| {
        match outcome.known.first().map(|known| known.share.unwrap_or_default()) {
            None => "nothing hidden",
            Some(share) if share < 0.1 => "below a tenth",
            Some(share) if share < 0.5 => "a tenth to a half",
            Some(_) => "more than half",
        }
        .to_owned()
    })
}

fn rows(outcomes: &[DiverseOutcome], what: impl Fn(&DiverseOutcome) -> String) -> Vec<Row> {
    let mut groups: BTreeMap<String, Vec<&DiverseOutcome>> = BTreeMap::new();
    for outcome in outcomes {
        groups.entry(what(outcome)).or_default().push(outcome);
    }
    let row = |(what, group): (String, Vec<&DiverseOutcome>)| {
        let knowable = group.iter().filter(|outcome| outcome.is_knowable());
        let mut verdicts = BTreeMap::new();
        for outcome in &group {
            *verdicts.entry(outcome.verdict.clone()).or_default() += 1;
        }
        Row {
            what,
            knowable_first: knowable.fold(Share::default(), |s, o| s.with(o.is_first_right())),
            wrong_name: group.iter().fold(Share::default(), |s, o| s.with(o.has_wrong_name())),
            verdicts,
        }
    };
    groups.into_iter().map(row).collect()
}
