//! The result of a diverse trial.

use serde::Serialize;

use super::outcome::DiverseOutcome;
use super::score::DiverseScore;
use super::settings::DiverseSettings;

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
    /// Whether answers may be of an earlier run, before which the hash of a truth drawn then was told.
    pub resumed: bool,
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
        Self { format: 1, seed, first, sha256: sha256.into(), resumed: false, score, cases }
    }
}
