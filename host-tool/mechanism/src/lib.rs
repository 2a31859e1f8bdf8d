//! What can be known of any arm's rigid body from its torques.
//!
//! The torques of a chain depend on fewer numbers than its links have: some have no effect, others
//! act together. [`BaseParameters`] finds the combinations that count, [`given_values`] how far what a file
//! says of a link may be off.
#![forbid(unsafe_code)]

mod base_parameters;
mod combination;
mod link_doubt;
mod observation;

pub use base_parameters::BaseParameters;
pub use combination::Combination;
pub use link_doubt::{Reach, given_values, reaches};
pub use observation::{Observation, Settings};
