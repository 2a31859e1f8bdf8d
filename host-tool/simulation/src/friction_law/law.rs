//! What every law of friction answers.

use std::fmt::Debug;

use model::FrictionState;
use model::friction::{Friction, FrictionScale};

/// The friction of one joint, in volts of command, with whatever it remembers.
pub trait FrictionLaw: Debug + Send {
    /// Moves on by one step [s] at a velocity [rad/s] that is constant over it; the friction [V],
    /// positive against positive velocity.
    fn step(&mut self, scale: FrictionScale<f64>, velocity_rad_per_s: f64, step_s: f64) -> f64;

    /// The joint comes to rest between two logs: deflections are forgotten, warmth is not.
    fn rest(&mut self);

    /// Takes the deflection of bristles where it has any.
    fn set_bristles(&mut self, _state: FrictionState<f64>) {}
}

/// Coulomb and Stribeck level [V] at a velocity [rad/s], as effects have changed it; not below 0.
pub(super) fn level_v(
    friction: &Friction<f64>,
    scale: FrictionScale<f64>,
    velocity_rad_per_s: f64,
) -> f64 {
    (friction.stribeck_level(velocity_rad_per_s) * scale.level + scale.added_v).max(0.0)
}

/// Viscous friction [V] at a velocity [rad/s], as effects have changed it.
pub(super) fn viscous_v(
    friction: &Friction<f64>,
    scale: FrictionScale<f64>,
    velocity_rad_per_s: f64,
) -> f64 {
    friction.alpha2_v_s_per_rad * scale.viscous * velocity_rad_per_s
}
