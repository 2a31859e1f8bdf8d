//! The files that a diverse trial is written to.

use std::io::Write;
use std::path::Path;

use super::knowable::Known;
use super::outcome::DiverseOutcome;
use super::page::page;
use super::results::DiverseResults;
use crate::error::TrialError;
use crate::output::write_text;
use files::Problem;

/// Writes `diverse-trial.jsonl` (a line for each case), `.json` (the score) and `.md`.
///
/// # Errors
/// A file that cannot be written.
pub fn write(results: &DiverseResults, directory: &Path) -> Result<(), TrialError> {
    let lines: String = results.cases.iter().map(line).collect();
    write_text(&directory.join("diverse-trial.jsonl"), &lines)?;
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
    let path = directory.join("diverse-trial.jsonl");
    let file = std::fs::OpenOptions::new().append(true).create(true).open(&path);
    let written = file.and_then(|mut file| file.write_all(line(case).as_bytes()));
    Ok(written.map_err(|error| Problem::Unwritable(error).in_file(&path))?)
}

fn line(case: &DiverseOutcome) -> String {
    serde_json::to_string(case).unwrap_or_default() + "\n"
}

/// Writes what could be known of a case's causes into its directory, beside its truth.
///
/// # Errors
/// The file cannot be written.
pub fn write_known(known: &[Known], directory: &Path) -> Result<(), TrialError> {
    let text = serde_json::to_string_pretty(known).unwrap_or_default() + "\n";
    write_text(&directory.join("known.json"), &text)
}
