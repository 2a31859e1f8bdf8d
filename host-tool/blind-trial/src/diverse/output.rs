//! The files that a diverse trial is written to.

use std::path::Path;

use super::knowable::Known;
use super::page::page;
use super::results::DiverseResults;
use crate::error::TrialError;
use crate::output::write_text;

/// Writes `diverse-trial.jsonl` (a line for each case), `.json` (the score) and `.md`.
///
/// # Errors
/// A file that cannot be written.
pub fn write(results: &DiverseResults, directory: &Path) -> Result<(), TrialError> {
    let line = |case| serde_json::to_string(case).unwrap_or_default() + "\n";
    let lines: String = results.cases.iter().map(line).collect();
    write_text(&directory.join("diverse-trial.jsonl"), &lines)?;
    let json = serde_json::to_string_pretty(results).unwrap_or_default() + "\n";
    write_text(&directory.join("diverse-trial.json"), &json)?;
    write_text(&directory.join("diverse-trial.md"), &page(results))
}

/// Writes what could be known of a case's causes into its directory, beside its truth.
///
/// # Errors
/// The file cannot be written.
pub fn write_known(known: &[Known], directory: &Path) -> Result<(), TrialError> {
    let text = serde_json::to_string_pretty(known).unwrap_or_default() + "\n";
    write_text(&directory.join("known.json"), &text)
}
