//! The files that a trial is written to.

use std::path::Path;

use super::page::{ArmResults, page};
use crate::error::TrialError;
use crate::output::write_text;

/// Writes `arm-trial.json` and `arm-trial.md`.
///
/// # Errors
/// A file that cannot be written.
pub fn write(results: &ArmResults, directory: &Path) -> Result<(), TrialError> {
    let json = serde_json::to_string_pretty(results).unwrap_or_default() + "\n";
    write_text(&directory.join("arm-trial.json"), &json)?;
    write_text(&directory.join("arm-trial.md"), &page(results))
}
