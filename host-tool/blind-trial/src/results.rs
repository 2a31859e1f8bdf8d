//! What a trial leaves behind: `blind-trial.md` and `blind-trial.json`.

use std::io::Write;
use std::path::Path;

use serde::Serialize;

use super::error::TrialError;
use super::outcome::Outcome;
use super::score::Score;
use super::table;
use files::Problem;
use files::replace::replace_file;

/// The result of a trial.
#[derive(Clone, Debug, Serialize)]
pub struct Results {
    /// Version of this layout.
    pub format: u32,
    /// The seed.
    pub seed: u32,
    /// Number of the first case.
    pub first: u32,
    /// SHA-256 of the truth.
    pub sha256: String,
    /// The score.
    pub score: Score,
    /// Truth and answer of each case.
    pub cases: Vec<Outcome>,
}

impl Results {
    /// Scores the outcomes.
    pub fn new(seed: u32, first: u32, sha256: &str, cases: Vec<Outcome>) -> Self {
        Self { format: 1, seed, first, sha256: sha256.into(), score: Score::of(&cases), cases }
    }

    /// Writes the page and the numbers.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, directory: &Path) -> Result<(), TrialError> {
        let json = serde_json::to_string_pretty(self).unwrap_or_default() + "\n";
        write(&directory.join("blind-trial.json"), &json)?;
        write(&directory.join("blind-trial.md"), &table::page(self))
    }
}

/// Writes a text, whole or not at all.
pub(super) fn write(path: &Path, text: &str) -> Result<(), TrialError> {
    Ok(replace_file(path, |out| out.write_all(text.as_bytes()).map_err(Problem::Unwritable))?)
}
