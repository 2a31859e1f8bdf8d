//! Joint friction as MuJoCo's soft constraint makes it: a joint that is held creeps.
//!
//! `frictionloss` holds a joint by a force that brakes its velocity with 2 / (0.95 x 0.02 s) and
//! gives in to a tenth (default solref and solimp). While it holds, force is proportional to
//! velocity; at the loss it stays. Force follows velocity within a millisecond.

use model::friction::{Friction, FrictionScale};

use super::law::{FrictionLaw, viscous_v};

/// How fast the force goes to its value [1/s]: 9 x 2 / (0.95 x 0.02 s).
const RATE_PER_S: f64 = 947.0;

/// alpha0 v / w held at +-alpha0, a millisecond late, and alpha2 v.
#[derive(Clone, Copy, Debug)]
pub struct SoftConstraint {
    friction: Friction<f64>,
    creep_rad_per_s: f64,
    held_v: f64,
}

impl SoftConstraint {
    /// With the velocity [rad/s], above 0, at which the loss is reached.
    pub fn new(friction: Friction<f64>, creep_rad_per_s: f64) -> Self {
        Self { friction, creep_rad_per_s, held_v: 0.0 }
    }
}

impl FrictionLaw for SoftConstraint {
    fn step(&mut self, scale: FrictionScale<f64>, velocity_rad_per_s: f64, step_s: f64) -> f64 {
        let loss_v = (self.friction.alpha0_v * scale.level + scale.added_v).max(0.0);
        let target_v = loss_v * (velocity_rad_per_s / self.creep_rad_per_s).clamp(-1.0, 1.0);
        self.held_v -= (target_v - self.held_v) * (-RATE_PER_S * step_s).exp_m1();
        self.held_v + viscous_v(&self.friction, scale, velocity_rad_per_s)
    }

    fn rest(&mut self) {
        self.held_v = 0.0;
    }
}
