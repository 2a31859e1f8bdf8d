//! A model that is fitted to the logs, and what it leaves of them.

use crate::fit::linearisation::Linearisation;
use crate::fit::residual_stats::ResidualStats;
use crate::rows::evidence::Evidence;
use crate::trial::hypothesis::EffectInstance;

/// A model and what it leaves.
pub struct FittedModel {
    /// The model.
    pub linear: Linearisation,
    /// What it leaves, against the noise.
    pub stats: ResidualStats,
}

impl FittedModel {
    /// A model with what it leaves.
    pub fn of(evidence: &Evidence, linear: Linearisation) -> Self {
        let stats = ResidualStats::of(evidence, &linear);
        Self { linear, stats }
    }

    /// Whether the last of its effects is a spring between motor and link.
    pub fn ends_with_spring(&self) -> bool {
        self.linear.hypothesis.effects.last().is_some_and(EffectInstance::is_spring)
    }

    /// Score of the model, rows held out with it.
    pub fn total(&self) -> f64 {
        self.linear.objective + self.linear.score().holdout
    }
}
