//! What a hypothesis, a model with effects, leaves of the command.

pub mod doubt;
pub mod link_motion;
pub mod parts;
pub mod reading;
pub mod voltage;
