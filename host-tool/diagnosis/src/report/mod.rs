//! The report, in figures and words.

pub mod assembly;
pub mod motion_gap;
pub mod sentence;
