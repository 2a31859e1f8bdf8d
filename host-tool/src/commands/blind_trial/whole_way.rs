//! `rrr blind-trial --whole-way`: record, identify, a change, record, diagnose.

use super::workers::on_all_cores;
use crate::failure::Failure;
use crate::say;
use crate::terminal::answer::answer;
use blind_trial::whole_way::{self, WholeWayResults, WholeWaySettings};
use blind_trial::{Case, RunSettings};
use diagnosis::{Criteria, diagnose};
use rig::effects::Catalogue;

/// Walks the whole way with each robot, and scores.
pub(super) fn run(settings: &WholeWaySettings, run: &RunSettings) -> Result<(), Failure> {
    let robots = whole_way::draw_robots(settings);
    let mut outcomes = on_all_cores(&robots, &|robot| walk(robot, settings, run))?;
    outcomes.sort_by_key(|outcome| outcome.outcome.case);
    let results = WholeWayResults::new(settings, outcomes);
    whole_way::write(&results, &run.out)?;
    say!("\n{}", whole_way::page(&results));
    say!("Robots: {}", run.out.join("whole-way.md").display());
    answer(&results)
}

fn walk(
    robot: &Case,
    settings: &WholeWaySettings,
    run: &RunSettings,
) -> Result<whole_way::WholeWayOutcome, Failure> {
    let outcome = whole_way::walk(robot, settings, run, &|campaign| {
        diagnose(campaign, &Catalogue::standard(), &Criteria::default(), &|_| ())
            .map_err(|error| error.to_string())
    })?;
    let answer = whole_way::answer(&outcome);
    say!("robot {:03}: {answer}, {:.0} s", outcome.outcome.case, outcome.outcome.seconds);
    Ok(outcome)
}
