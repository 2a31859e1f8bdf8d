//! How well the answers of a diverse trial fit its truths.

mod answers;
mod equivalence;
mod intervals;
mod reliability;
mod rows;

pub use answers::{Answers, KNOWABLE};
pub(crate) use equivalence::names;
pub use intervals::Intervals;
pub use reliability::Reliability;
pub use rows::{Row, Times};

use serde::Serialize;

use super::outcome::DiverseOutcome;

/// The score of a diverse trial.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DiverseScore {
    /// How many names are right.
    pub answers: Answers,
    /// Whether probabilities mean what they say.
    pub reliability: Reliability,
    /// Whether intervals hold.
    pub intervals: Intervals,
    /// By law of friction.
    pub by_friction: Vec<Row>,
    /// By largest cause.
    pub by_cause: Vec<Row>,
    /// By size of the largest cause: its share of the gap.
    pub by_share: Vec<Row>,
    /// What it took.
    pub times: Times,
}

impl DiverseScore {
    /// Of all cases of a trial.
    pub fn of(outcomes: &[DiverseOutcome]) -> Self {
        Self {
            answers: Answers::of(outcomes),
            reliability: Reliability::of(outcomes),
            intervals: Intervals::of(outcomes),
            by_friction: rows::by_friction(outcomes),
            by_cause: rows::by_cause(outcomes),
            by_share: rows::by_share(outcomes),
            times: Times::of(outcomes),
        }
    }
}

#[cfg(test)]
mod tests;
