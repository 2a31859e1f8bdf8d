//! Where a real robot differs from its model, what causes it, and how much of the gap goes
//! away when the cause is added.

pub mod candidate;
pub mod doubt;
pub mod even_clock;
pub mod evidence;
pub mod fit;
pub mod harmonics;
pub mod linearisation;
mod link_motion;
pub mod noise;
pub mod parts;
pub mod places;
pub mod preparation;
pub mod quantity;
mod reading;
pub mod rest;
mod result;
pub mod row_filter;
pub mod search;
pub mod selection;
pub mod sentence;
pub mod stretch;
pub mod subject;
#[cfg(test)]
pub(crate) mod synthetic;
pub mod unknowns;
pub mod voltage;

pub use places::places;
pub use result::*;
pub use sentence::sentence;

use crate::identification::{Campaign, StepError};
use crate::progress::Steps;

/// How a diagnosis works.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {}

/// Diagnoses the logs of a campaign against the model in its robot file.
///
/// # Errors
/// Logs that do not fit the model's robot, or that cannot be used.
pub fn diagnose(
    _campaign: &Campaign,
    _settings: &Settings,
    _steps: &Steps,
) -> Result<Diagnosis, StepError> {
    Err(StepError::Numerical { step: "diagnosis", what: "not there yet".into() })
}
