//! A value with its uncertainty, and why a step gives none.

use serde::Serialize;

/// An estimated value.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// The value, in the unit that its name says.
    pub value: f64,
    /// Its standard error, in the same unit.
    pub standard_error: f64,
    /// The 95 % interval.
    pub interval: [f64; 2],
    /// What the reader must know, such as that the data cannot carry the value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

impl Estimate {
    /// A normally distributed estimate.
    pub fn new(value: f64, standard_error: f64) -> Self {
        const QUANTILE: f64 = 1.959_964;
        let half = QUANTILE * standard_error;
        Self { value, standard_error, interval: [value - half, value + half], note: None }
    }

    /// With a remark for the reader.
    pub fn with_note(self, note: impl Into<String>) -> Self {
        Self { note: Some(note.into()), ..self }
    }

    /// Whether the 95 % interval holds a value.
    pub fn covers(&self, truth: f64) -> bool {
        (self.interval[0]..=self.interval[1]).contains(&truth)
    }
}

/// Why a step cannot give what it should; the cure stands in the words.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StepError {
    /// No log of this experiment.
    #[error("{step}: no log of {experiment} is there; record that experiment")]
    NoLog {
        /// The step that needs it.
        step: &'static str,
        /// The experiment, with its joint where it has one.
        experiment: String,
    },
    /// A log that does not hold what the step needs.
    #[error("{file}: {what}")]
    Unusable {
        /// The log.
        file: String,
        /// What is wrong with it, and what to do.
        what: String,
    },
    /// The numbers did not work out.
    #[error("{step}: {what}")]
    Numerical {
        /// The step.
        step: &'static str,
        /// What happened.
        what: String,
    },
}
