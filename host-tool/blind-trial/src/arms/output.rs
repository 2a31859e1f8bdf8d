//! The files that a trial is written to.

use std::path::Path;

use super::outcome::ArmOutcome;
use super::page::{ArmResults, page};
use crate::error::TrialError;
use crate::output::{append_line, json_line, write_text};

/// Appends a case to `arm-trial.jsonl` as it is done; [`write`] puts all in order at the end.
///
/// # Errors
/// The file cannot be written.
pub fn append(case: &ArmOutcome, directory: &Path) -> Result<(), TrialError> {
    append_line(&directory.join("arm-trial.jsonl"), case)
}

/// Writes `arm-trial.jsonl` (a line for each case), `arm-trial.json` and `arm-trial.md`.
///
/// # Errors
/// A file that cannot be written.
pub fn write(results: &ArmResults, directory: &Path) -> Result<(), TrialError> {
    let lines: String = results.cases.iter().map(json_line).collect();
    write_text(&directory.join("arm-trial.jsonl"), &lines)?;
    let json = serde_json::to_string_pretty(results).unwrap_or_default() + "\n";
    write_text(&directory.join("arm-trial.json"), &json)?;
    write_text(&directory.join("arm-trial.md"), &page(results))
}
