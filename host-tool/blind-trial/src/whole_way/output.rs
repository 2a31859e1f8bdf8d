//! The files that a trial of the whole way is written to.

use std::path::Path;

use super::page::page;
use super::results::WholeWayResults;
use crate::error::TrialError;
use crate::output::write_text;

/// Writes `whole-way.jsonl` (a line for each robot), `.json` (the score) and `.md`.
///
/// # Errors
/// A file that cannot be written.
pub fn write(results: &WholeWayResults, directory: &Path) -> Result<(), TrialError> {
    let line = |robot| serde_json::to_string(robot).unwrap_or_default() + "\n";
    let lines: String = results.robots.iter().map(line).collect();
    write_text(&directory.join("whole-way.jsonl"), &lines)?;
    let json = serde_json::to_string_pretty(results).unwrap_or_default() + "\n";
    write_text(&directory.join("whole-way.json"), &json)?;
    write_text(&directory.join("whole-way.md"), &page(results))
}
