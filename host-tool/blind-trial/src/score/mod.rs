//! How well the answers fit the truths.

mod calibration;
mod confusion;
mod counts;
mod median;
mod parameters;
mod shrinkage;

pub use calibration::{Bin, Calibration};
pub use confusion::ConfusionRow;
pub use counts::{Foreign, Joints, NoEffect, Pairs, Share, Singles};
pub use parameters::{ParameterError, ParameterScore, errors};
pub use shrinkage::Shrinkage;

use serde::Serialize;

use super::answer::Answer;
use super::outcome::Outcome;
use rig::effects::Catalogue;

/// The score of a trial.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Score {
    /// How many cases are wholly right.
    pub right: Share,
    /// Diagnoses that gave no report.
    pub failed: Share,
    /// Cases of one effect.
    pub singles: Singles,
    /// Cases of two.
    pub pairs: Pairs,
    /// Cases with nothing hidden.
    pub nothing: NoEffect,
    /// Cases of an effect that the catalogue does not have.
    pub foreign: Foreign,
    /// Whether the joint is right.
    pub joints: Joints,
    /// What was named first, for each truth of one effect or none.
    pub confusion: Vec<ConfusionRow>,
    /// Errors of the parameters of the causes that are rightly named.
    pub parameters: Vec<ParameterScore>,
    /// How much of the gap that can be closed was closed.
    pub shrinkage: Shrinkage,
    /// Whether confidences mean what they say.
    pub calibration: Calibration,
    /// Mean time of a diagnosis [s].
    pub mean_seconds: f64,
}

impl Score {
    /// Of all cases of a trial.
    pub fn of(outcomes: &[Outcome], catalogue: &Catalogue) -> Self {
        let failed = |outcome: &Outcome| matches!(outcome.answer, Answer::Failed(_));
        let seconds: f64 = outcomes.iter().map(|outcome| outcome.seconds).sum();
        Self {
            right: Share::among(outcomes, Outcome::is_right),
            failed: Share::among(outcomes, failed),
            singles: Singles::of(outcomes),
            pairs: Pairs::of(outcomes),
            nothing: NoEffect::of(outcomes),
            foreign: Foreign::of(outcomes),
            joints: Joints::of(outcomes),
            confusion: confusion::rows(outcomes, catalogue),
            parameters: parameters::scores(outcomes),
            shrinkage: Shrinkage::of(outcomes),
            calibration: Calibration::of(outcomes),
            mean_seconds: seconds / outcomes.len().max(1) as f64,
        }
    }
}

#[cfg(test)]
mod tests;
