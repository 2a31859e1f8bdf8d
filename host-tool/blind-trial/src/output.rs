//! What a trial writes: `blind-trial.md` and `blind-trial.json`.

use std::io::Write;
use std::path::Path;

use super::error::TrialError;
use super::markdown::page;
use super::results::Results;
use files::Problem;
use files::replace::replace_file;

/// Writes the page and the numbers into a directory.
///
/// # Errors
/// A file that cannot be written.
pub fn write(results: &Results, directory: &Path) -> Result<(), TrialError> {
    let json = serde_json::to_string_pretty(results).unwrap_or_default() + "\n";
    write_text(&directory.join("blind-trial.json"), &json)?;
    write_text(&directory.join("blind-trial.md"), &page(results))
}

/// Writes a text, whole or not at all.
pub(super) fn write_text(path: &Path, text: &str) -> Result<(), TrialError> {
    Ok(replace_file(path, |out| out.write_all(text.as_bytes()).map_err(Problem::Unwritable))?)
}
