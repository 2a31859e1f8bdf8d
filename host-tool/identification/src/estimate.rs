//! A value with its uncertainty.

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
    /// A reservation, such as that the data do not determine the value.
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
