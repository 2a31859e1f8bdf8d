//! What a hypothesis, a model with effects, leaves of the command.

pub mod active_effects;
pub mod coupling;
mod drive;
pub mod equation;
pub mod held_warmth;
pub mod hypothesis;
pub mod link_covariance;
pub mod link_motion;
mod links;
pub mod motor_side;
pub mod parts;
pub mod payload;
pub mod reading;
pub mod residual_rows;
pub mod rigid_body;
pub mod rigid_rows;
pub mod spring_change;
#[cfg(test)]
pub(crate) mod test_effects;
#[cfg(test)]
pub(crate) mod test_stretch;
#[cfg(test)]
mod tests;
pub mod warmth;
