//! The files that a diverse trial is written to.

use std::path::Path;

use super::knowable::Known;
use super::outcome::DiverseOutcome;
use super::page::page;
use super::results::DiverseResults;
use crate::error::TrialError;
use crate::output::{append_line, json_line, write_text};

/// A line for each case.
pub(super) const LINES: &str = "diverse-trial.jsonl";

/// Writes `diverse-trial.jsonl` (a line for each case), `.json` (the score) and `.md`.
///
/// # Errors
/// A file that cannot be written.
pub fn write(results: &DiverseResults, directory: &Path) -> Result<(), TrialError> {
    let lines: String = results.cases.iter().map(json_line).collect();
    write_text(&directory.join(LINES), &lines)?;
    let json = serde_json::to_string_pretty(results).unwrap_or_default() + "\n";
    write_text(&directory.join("diverse-trial.json"), &json)?;
    write_text(&directory.join("diverse-trial.md"), &page(results))
}

/// Appends a case to `diverse-trial.jsonl` as it is done, so that a trial that is cut short keeps
/// what it has; [`write`] puts all in order at the end.
///
/// # Errors
/// The file cannot be written.
pub fn append(case: &DiverseOutcome, directory: &Path) -> Result<(), TrialError> {
    append_line(&directory.join(LINES), case)
}

/// Writes what could be known of a case's causes into its directory, beside its truth.
///
/// # Errors
/// The file cannot be written.
pub fn write_known(known: &[Known], directory: &Path) -> Result<(), TrialError> {
    let text = serde_json::to_string_pretty(known).unwrap_or_default() + "\n";
    write_text(&directory.join("known.json"), &text)
}
