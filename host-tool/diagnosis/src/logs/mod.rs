//! The rig and its logs.

pub mod checks;
pub mod encoder_step;
pub mod even_clock;
pub mod intervals;
pub mod stamps;
pub mod stretch;
pub mod subject;
pub mod usable;
