//! What a case's robot is beyond its causes: friction of other laws, small effects everywhere,
//! coloured noise, a coarse encoder, a bus that loses rows, a model that is off.
//!
//! A case of the plain trial has none of it.

mod bus;
mod coloured_noise;
mod friction;
mod world;

pub use bus::Bus;
pub use coloured_noise::ColouredNoise;
pub use friction::{Heat, JointFriction, Law};
pub use world::{ModelError, Reality};
