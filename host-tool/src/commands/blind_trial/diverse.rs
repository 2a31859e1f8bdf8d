//! `rrr blind-trial --diverse`: robots that do not share friction, effects and noise with the
//! diagnosis.

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use super::workers::on_all_cores;
use crate::failure::Failure;
use crate::say;
use crate::terminal::answer::answer;
use crate::terminal::progress::Progress;
use blind_trial::diverse::{
    self, DiverseCase, DiverseOutcome, DiverseResults, DiverseSettings, Earlier, diagnose_diverse,
    draw_diverse, true_effects,
};
use blind_trial::{RunSettings, SealedTruth, logs, sealed_truth};
use diagnosis::{Criteria, diagnose_suspecting};
use rig::effects::Catalogue;

/// How a diverse trial is run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// Whether answers that are in its directory are taken from there: it goes on with a trial that was stopped.
    pub(super) resumes: bool,
    /// Whether searches try the true causes first.
    pub(super) suspects_truth: bool,
}

/// Draws, seals, has diagnosed, and scores.
pub(super) fn run(settings: &DiverseSettings, run: &RunSettings, way: Way) -> Result<(), Failure> {
    let (cases, truth) = sealed(settings, &run.out)?;
    let earlier = if way.resumes { Earlier::read(&run.out)? } else { Vec::new() };
    let known = |case: &DiverseCase| earlier.iter().find_map(|earlier| earlier.outcome(case));
    let mut outcomes = on_all_cores(&cases, &|case| match known(case) {
        Some(outcome) => Ok(outcome),
        None => diagnose_one(case, run, way.suspects_truth),
    })?;
    outcomes.sort_by_key(|outcome| outcome.case);
    truth.reveal(&run.out)?;
    say!("SHA-256 of the truth, opened: {}\n", truth.hash());
    let results = DiverseResults::new(settings, truth.hash(), outcomes);
    let results = DiverseResults { resumed: way.resumes, ..results };
    diverse::write(&results, &run.out)?;
    say!("{}", diverse::short(&results));
    say!("Cases: {}", run.out.join("diverse-trial.md").display());
    answer(&results)
}

/// Writes the logs of all cases with their truth, without a diagnosis.
pub(super) fn draw_only(settings: &DiverseSettings, out: &Path) -> Result<(), Failure> {
    let (cases, truth) = sealed(settings, out)?;
    let progress = Progress::new("recording", cases.len() as u64);
    for (done, DiverseCase { case, known }) in (1..).zip(&cases) {
        let directory = logs::directory(out, case.number);
        logs::write(case, &directory)?;
        sealed_truth::write_truth(case, &directory)?;
        diverse::write_known(known, &directory)?;
        progress.at(done);
    }
    progress.finish();
    truth.reveal(out)?;
    say!("{} cases in {}", cases.len(), out.display());
    Ok(())
}

/// The cases, and their truth, whose hash is told.
fn sealed(
    settings: &DiverseSettings,
    out: &Path,
) -> Result<(Vec<DiverseCase>, SealedTruth), Failure> {
    let progress = Progress::new("drawing cases", u64::from(settings.cases));
    let done = AtomicU64::new(0);
    let one_more = || progress.at(done.fetch_add(1, Ordering::Relaxed) + 1);
    let cases = draw_diverse(settings, &one_more)?;
    progress.finish();
    let truth = SealedTruth::new(&cases.iter().map(|c| c.case.clone()).collect::<Vec<_>>());
    say!("SHA-256 of the truth: {}", truth.hash());
    truth.write_hash(out)?;
    Ok((cases, truth))
}

fn diagnose_one(
    case: &DiverseCase,
    run: &RunSettings,
    suspects_truth: bool,
) -> Result<DiverseOutcome, Failure> {
    let suspected = if suspects_truth { true_effects(&case.case) } else { Vec::new() };
    let mut outcome = diagnose_diverse(case, run, &|campaign| {
        let (catalogue, criteria) = (Catalogue::standard(), Criteria::default());
        diagnose_suspecting(campaign, &catalogue, &criteria, &suspected, &|_| ())
            .map_err(|error| error.to_string())
    })?;
    outcome.suspects_truth = suspects_truth;
    diverse::append(&outcome, &run.out)?;
    let answer = diverse::answer(&outcome);
    say!("case {:03}: {answer}, {:.0} s", outcome.case, outcome.seconds);
    Ok(outcome)
}
