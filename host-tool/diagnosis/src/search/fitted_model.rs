//! A model that is fitted to the logs, and what it leaves of them.

use crate::fit::linearisation::Linearisation;
use crate::fit::residual_stats::ResidualStats;
use crate::rows::evidence::Evidence;

/// A model and what it leaves.
pub struct FittedModel {
    /// The model.
    pub linear: Linearisation,
    /// What it leaves, against the noise.
    pub stats: ResidualStats,
}

/// Most steps of a fit whose last effect is a spring, whose values are far from linear.
pub(super) const SPRING_STEPS: usize = 10;

impl FittedModel {
    /// A model with what it leaves.
    pub fn of(evidence: &Evidence, linear: Linearisation) -> Self {
        let stats = ResidualStats::of(evidence, &linear);
        Self { linear, stats }
    }

    /// Score of the model, rows held out with it.
    pub fn total(&self) -> f64 {
        self.linear.objective + self.linear.score().holdout
    }
}
