//! The result of a diverse trial, and the files that it is written to.

use std::path::Path;

use serde::Serialize;

use super::knowable::Known;
use super::outcome::DiverseOutcome;
use super::page::page;
use super::score::DiverseScore;
use super::settings::DiverseSettings;
use crate::error::TrialError;
use crate::output::write_text;

/// The result of a diverse trial.
#[derive(Clone, Debug, Serialize)]
pub struct DiverseResults {
    /// Version of this layout.
    pub format: u32,
    /// The seed.
    pub seed: u32,
    /// Number of the first case.
    pub first: u32,
    /// SHA-256 of the truth.
    pub sha256: String,
    /// The score.
    pub score: DiverseScore,
    /// Truth and answer of each case; they have a file of their own.
    #[serde(skip)]
    pub cases: Vec<DiverseOutcome>,
}

impl DiverseResults {
    /// Scores the outcomes.
    pub fn new(settings: &DiverseSettings, sha256: &str, cases: Vec<DiverseOutcome>) -> Self {
        let (seed, first) = (settings.seed, settings.first);
        let score = DiverseScore::of(&cases);
        Self { format: 1, seed, first, sha256: sha256.into(), score, cases }
    }
}

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
