//! Recorded experiments, ready for use, and whether they can be what they say.
#![forbid(unsafe_code)]

pub mod campaign;
mod error;
pub mod motion;
pub mod one_joint;
pub mod plausibility;
pub mod smoothed;
pub mod tracking;
mod unbroken;

pub use campaign::{Campaign, JointTrace, Known, Trace};
pub use error::StepError;
pub use tracking::Tracking;
pub use unbroken::unbroken;
