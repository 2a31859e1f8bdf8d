//! What a trial writes: `blind-trial.md` and `blind-trial.json`.

use std::fs::OpenOptions;
use std::io::Write;
use std::path::Path;

use serde::Serialize;

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

/// A value as a line of JSON.
pub(super) fn json_line(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default() + "\n"
}

/// Appends a value as a line of JSON, so that a trial that is cut short keeps what it has.
pub(super) fn append_line(path: &Path, value: &impl Serialize) -> Result<(), TrialError> {
    let file = OpenOptions::new().append(true).create(true).open(path);
    let written = file.and_then(|mut file| file.write_all(json_line(value).as_bytes()));
    Ok(written.map_err(|error| Problem::Unwritable(error).in_file(path))?)
}

/// Writes a text, whole or not at all.
pub(super) fn write_text(path: &Path, text: &str) -> Result<(), TrialError> {
    Ok(replace_file(path, |out| out.write_all(text.as_bytes()).map_err(Problem::Unwritable))?)
}
