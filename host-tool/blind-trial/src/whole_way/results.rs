//! The result of a trial of the whole way.

use std::collections::BTreeMap;

use serde::Serialize;

use super::run::WholeWayOutcome;
use super::settings::WholeWaySettings;
use crate::score::Share;

/// The result of a trial of the whole way.
#[derive(Clone, Debug, Serialize)]
pub struct WholeWayResults {
    /// Version of this layout.
    pub format: u32,
    /// The seed.
    pub seed: u32,
    /// Number of the first robot.
    pub first: u32,
    /// Changes named first, with their joint.
    pub named_first: Share,
    /// Changes named at all.
    pub named: Share,
    /// Robots that could not be identified, changed or diagnosed.
    pub failed: Share,
    /// Robots on which a name was given for which there is nothing.
    pub wrong_name: Share,
    /// By law of friction.
    pub by_law: Vec<WholeWayRow>,
    /// By change.
    pub by_change: Vec<WholeWayRow>,
    /// Robot by robot; they have a file of their own.
    #[serde(skip)]
    pub robots: Vec<WholeWayOutcome>,
}

/// Robots that have something in common.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WholeWayRow {
    /// What they have in common.
    pub what: String,
    /// Changes named first.
    pub named_first: Share,
    /// A wrong name was given.
    pub wrong_name: Share,
}

impl WholeWayResults {
    /// Scores the outcomes.
    pub fn new(settings: &WholeWaySettings, robots: Vec<WholeWayOutcome>) -> Self {
        let all: Vec<&WholeWayOutcome> = robots.iter().collect();
        let law = |o: &WholeWayOutcome| o.outcome.reality.friction[0].law.name().to_owned();
        let change = |o: &WholeWayOutcome| {
            o.outcome.truth.first().map_or("failed before a change".into(), |t| t.effect.clone())
        };
        Self {
            format: 1,
            seed: settings.seed,
            first: settings.first,
            named_first: count(&all, |o| o.outcome.is_first_right()),
            named: count(&all, |o| o.outcome.has_named(0)),
            failed: count(&all, |o| o.outcome.failure.is_some()),
            wrong_name: count(&all, |o| o.outcome.has_wrong_name()),
            by_law: rows(&all, law),
            by_change: rows(&all, change),
            robots,
        }
    }
}

fn count(robots: &[&WholeWayOutcome], has: impl Fn(&WholeWayOutcome) -> bool) -> Share {
    robots.iter().fold(Share::default(), |share, robot| share.with(has(robot)))
}

fn rows(
    robots: &[&WholeWayOutcome],
    what: impl Fn(&WholeWayOutcome) -> String,
) -> Vec<WholeWayRow> {
    let mut groups: BTreeMap<String, Vec<&WholeWayOutcome>> = BTreeMap::new();
    for robot in robots {
        groups.entry(what(robot)).or_default().push(robot);
    }
    let row = |(what, group): (String, Vec<&WholeWayOutcome>)| WholeWayRow {
        what,
        named_first: count(&group, |o| o.outcome.is_first_right()),
        wrong_name: count(&group, |o| o.outcome.has_wrong_name()),
    };
    groups.into_iter().map(row).collect()
}
