//! `rrr blind-trial --arm`: other arms than the robot of three joints.

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use super::workers::on_all_cores;
use crate::failure::Failure;
use crate::say;
use crate::terminal::answer::answer;
use crate::terminal::progress::Progress;
use blind_trial::arms::{
    ArmCase, ArmOutcome, ArmResults, ArmTrialSettings, answer as in_words, append,
    diagnose_arm_case, draw_arms, record_arm_case, short, write,
};
use blind_trial::{RunSettings, SealedTruth};
use diagnosis::{Criteria, Report, diagnose_arm};
use recordings::ArmCampaign;
use rig::effects::Catalogue;
use servo::{Outcome, Settings, is_servo_arm, report::report};

/// Draws, seals, has diagnosed, and scores.
pub(super) fn run(settings: &ArmTrialSettings, run: &RunSettings) -> Result<(), Failure> {
    let (cases, truth) = sealed(settings, &run.out)?;
    let mut outcomes = on_all_cores(&cases, &|case| diagnose_one(case, run))?;
    outcomes.sort_by_key(|outcome| outcome.case);
    truth.reveal(&run.out)?;
    say!("SHA-256 of the truth, opened: {}\n", truth.hash());
    let results = ArmResults::new(settings, truth.hash(), outcomes);
    write(&results, &run.out)?;
    say!("{}", short(&results));
    say!("Cases: {}", run.out.join("arm-trial.md").display());
    answer(&results)
}

/// Writes the logs of all cases and their truth, without a diagnosis.
pub(super) fn draw_only(settings: &ArmTrialSettings, out: &Path) -> Result<(), Failure> {
    let (cases, truth) = sealed(settings, out)?;
    let progress = Progress::new("recording", cases.len() as u64);
    for (done, case) in (1..).zip(&cases) {
        record_arm_case(case, out)?;
        progress.at(done);
    }
    progress.finish();
    truth.reveal(out)?;
    say!("{} cases in {}", cases.len(), out.display());
    Ok(())
}

/// The cases, and their truth, whose hash is told.
fn sealed(settings: &ArmTrialSettings, out: &Path) -> Result<(Vec<ArmCase>, SealedTruth), Failure> {
    let cases = drawn(settings)?;
    let truth = SealedTruth::of(cases.clone());
    say!("SHA-256 of the truth: {}", truth.hash());
    truth.write_hash(out)?;
    Ok((cases, truth))
}

fn drawn(settings: &ArmTrialSettings) -> Result<Vec<ArmCase>, Failure> {
    let progress = Progress::new("drawing cases", u64::from(settings.cases));
    let done = AtomicU64::new(0);
    let cases = draw_arms(settings, &|| progress.at(done.fetch_add(1, Ordering::Relaxed) + 1))?;
    progress.finish();
    Ok(cases)
}

fn diagnose_one(case: &ArmCase, run: &RunSettings) -> Result<ArmOutcome, Failure> {
    let outcome = diagnose_arm_case(case, run, &diagnosed)?;
    append(&outcome, &run.out)?;
    say!("case {:03}: {}, {:.0} s", outcome.case, in_words(&outcome), outcome.seconds);
    Ok(outcome)
}

/// As `rrr diagnose` does.
fn diagnosed(campaign: &ArmCampaign) -> Result<Report, String> {
    if is_servo_arm(&campaign.arm) {
        let outcome = Outcome::of(campaign, &Settings::default(), &|_| ());
        return outcome.map(|found| report(&found)).map_err(|error| error.to_string());
    }
    let catalogue = Catalogue::of_arm(campaign.arm.joints.len());
    let found = diagnose_arm(campaign, &catalogue, &Criteria::default(), &|_| ());
    found.map(|found| found.report).map_err(|error| error.to_string())
}
