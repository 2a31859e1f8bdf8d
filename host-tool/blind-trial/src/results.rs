//! The result of a trial.

use serde::Serialize;

use super::outcome::Outcome;
use super::score::Score;
use super::settings::DrawSettings;
use rig::effects::Catalogue;

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
    pub fn new(
        catalogue: &Catalogue,
        settings: &DrawSettings,
        sha256: &str,
        cases: Vec<Outcome>,
    ) -> Self {
        let (seed, first) = (settings.seed, settings.first);
        let score = Score::of(&cases, catalogue);
        Self { format: 1, seed, first, sha256: sha256.into(), score, cases }
    }
}
