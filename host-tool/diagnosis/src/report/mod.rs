//! The report, in figures and words.

pub mod amended;
pub mod assembly;
pub mod causes;
pub mod doubt;
pub mod log_residuals;
pub mod motion_gap;
pub mod parameters_changed;
pub mod remainder;
pub mod remaining_words;
pub mod samples;
pub mod sentence;
mod torque_constants;
pub mod warmth;
pub mod words;
