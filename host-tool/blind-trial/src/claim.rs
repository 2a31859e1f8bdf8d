//! A cause that is named, with its parameters and intervals: for the diverse trial and those of other arms.

use std::collections::BTreeMap;

use diagnosis::{Cause, Interval, Value};
use serde::{Deserialize, Serialize};

use crate::cause;

/// A cause that was named.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Claim {
    /// The effect.
    pub effect: String,
    /// Joint, 1 to 3; 0 for the whole robot.
    pub joint: u8,
    /// Its parameters by name.
    pub parameters: BTreeMap<String, Value>,
    /// How sure the diagnosis is.
    pub probability: f64,
    /// 95 % interval of its share of the gap.
    pub share_interval: [f64; 2],
    /// 95 % intervals of its parameters, component by component.
    pub parameter_intervals: BTreeMap<String, Vec<[f64; 2]>>,
}

impl Claim {
    /// Of a cause in a report.
    pub fn of(cause: &Cause) -> Self {
        let intervals = cause.parameter_intervals.iter();
        Self {
            effect: cause.effect.clone(),
            joint: cause.joint,
            parameters: cause.parameters.clone(),
            probability: cause.probability,
            share_interval: cause.share_interval,
            parameter_intervals: intervals
                .map(|(name, each)| (name.clone(), sides(each)))
                .collect(),
        }
    }
}

/// The interval of each component.
fn sides(interval: &Interval) -> Vec<[f64; 2]> {
    match interval {
        Interval::Number(sides) => vec![*sides],
        Interval::Vector(components) => components.clone(),
    }
}

/// An answer in words: why it failed, or its verdict and its causes with their probabilities.
pub fn answer_in_words(failure: Option<&str>, verdict: &str, claims: &[Claim]) -> String {
    if let Some(why) = failure {
        return format!("failed: {why}");
    }
    let words = |claim: &Claim| {
        format!("{} ({:.2})", cause::words(&claim.effect, claim.joint), claim.probability)
    };
    let words: Vec<String> = claims.iter().map(words).collect();
    if words.is_empty() { verdict.into() } else { format!("{verdict}: {}", words.join(", ")) }
}
