//! Has a case diagnosed from its files alone.

use std::path::{Path, PathBuf};

use diagnosis::Report;
use recordings::ArmCampaign;

use super::case::ArmCase;
use super::logs::{read, write};
use super::outcome::ArmOutcome;
use crate::answer::Answer;
use crate::claim::Claim;
use crate::error::TrialError;
use crate::logs;
use crate::outcome::RunSettings;
use crate::thread_time::thread_time;

/// Whatever diagnoses an arm's logs: the report, or why there is none.
pub type DiagnoseArm<'a> = &'a dyn Fn(&ArmCampaign) -> Result<Report, String>;

/// Records the logs of a case, and writes them with the model into the directory of the case, which is returned.
///
/// # Errors
/// Logs that cannot be recorded or written.
pub fn record_arm_case(case: &ArmCase, out: &Path) -> Result<PathBuf, TrialError> {
    let directory = logs::directory(out, case.number);
    write(&case.record()?, &directory)?;
    Ok(directory)
}

/// Writes the logs of a case, reads them back and has them diagnosed. Processor time is this thread's,
/// which must do all the work.
///
/// # Errors
/// Logs that cannot be recorded, written or read. A diagnosis that fails is an answer.
pub fn diagnose_arm_case(
    case: &ArmCase,
    settings: &RunSettings,
    diagnose: DiagnoseArm,
) -> Result<ArmOutcome, TrialError> {
    let directory = record_arm_case(case, &settings.out)?;
    let campaign = read(&directory)?;
    let began = thread_time();
    let answer = Answer::of(|| diagnose(&campaign));
    let seconds = thread_time().saturating_sub(began).as_secs_f64();
    if !settings.keep_logs {
        logs::remove(&directory)?;
    }
    Ok(outcome(case, &answer, seconds))
}

fn outcome(case: &ArmCase, answer: &Answer, seconds: f64) -> ArmOutcome {
    ArmOutcome {
        case: case.number,
        arm: case.arm,
        kind: case.kind,
        truth: case.cause.clone(),
        oracle: case.oracle,
        verdict: answer.verdict(),
        failure: answer.failure().map(str::to_owned),
        claims: answer.named().iter().map(Claim::of).collect(),
        seconds,
    }
}
