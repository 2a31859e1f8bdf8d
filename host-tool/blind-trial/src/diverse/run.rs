//! Has diverse cases diagnosed.

use std::cell::{Cell, RefCell};
use std::path::Path;

use super::beside::beside;
use super::draw::DiverseCase;
use super::outcome::DiverseOutcome;
use super::told::told;
use crate::claim::Claim;
use crate::error::TrialError;
use crate::logs;
use crate::outcome::{RunSettings, answer_to};
use crate::thread_time::thread_time;
use diagnosis::{Criteria, Diagnosis};
use recordings::Campaign;

/// Whatever diagnoses logs: all that it found, or why there is nothing.
pub type DiagnoseWhole<'a> = &'a dyn Fn(&Campaign) -> Result<Diagnosis, String>;

/// Writes the logs of a case, reads them back and diagnoses them; `diagnose` is given nothing
/// else. Processor time is this thread's, which must do all the work.
///
/// # Errors
/// Logs that cannot be recorded, written or read back. A diagnosis that fails is an answer.
pub fn diagnose_diverse(
    case: &DiverseCase,
    settings: &RunSettings,
    diagnose: DiagnoseWhole,
) -> Result<DiverseOutcome, TrialError> {
    let directory = logs::directory(&settings.out, case.case.number);
    logs::write(&case.case, &directory)?;
    diagnose_written(case, &directory, settings.keep_logs, diagnose)
}

/// Diagnoses the logs of a case that are in a directory, with the model beside them.
///
/// # Errors
/// Logs that cannot be read. A diagnosis that fails is an answer.
pub(crate) fn diagnose_written(
    DiverseCase { case, known }: &DiverseCase,
    directory: &Path,
    keep_logs: bool,
    diagnose: DiagnoseWhole,
) -> Result<DiverseOutcome, TrialError> {
    let processor_s = Cell::new(0.0);
    let told_shares = RefCell::new(Vec::new());
    let (answer, seconds) = answer_to(directory, keep_logs, &|campaign| {
        let began = thread_time();
        let answer = diagnose(campaign);
        processor_s.set(thread_time().saturating_sub(began).as_secs_f64());
        // By the report's doubt; where there is no report, by what is thought before one.
        let by =
            answer.as_ref().map_or_else(|_| Criteria::default(), |found| found.criteria.clone());
        told_shares.replace(told(case, campaign, &by));
        Ok(answer?.report)
    })?;
    let Some(reality) = case.reality.clone() else {
        return Err(TrialError::NoReality(case.number));
    };
    Ok(DiverseOutcome {
        case: case.number,
        kind: case.kind,
        truth: case.causes.clone(),
        known: known.clone(),
        told_shares: told_shares.into_inner(),
        suspects_truth: false,
        reality,
        beside: beside(case),
        verdict: answer.verdict(),
        failure: answer.failure().map(str::to_owned),
        claims: answer.named().iter().map(Claim::of).collect(),
        seconds,
        processor_seconds: processor_s.get(),
        report: answer.report().map(|report| serde_json::json!(report)),
    })
}
