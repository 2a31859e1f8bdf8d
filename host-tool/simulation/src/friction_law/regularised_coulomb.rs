//! Coulomb friction whose jump at rest is made a steep slope: no state, and so no stiction.

use model::friction::{Friction, FrictionScale};

use super::law::{FrictionLaw, level_v, viscous_v};

/// How the sign of the velocity is made smooth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slope {
    /// tanh(v / w).
    Tanh,
    /// v / w, held at +-1.
    Ramp,
}

/// gamma(v) s(v / w) + alpha2 v.
#[derive(Clone, Copy, Debug)]
pub struct RegularisedCoulomb {
    friction: Friction<f64>,
    slope: Slope,
    width_rad_per_s: f64,
}

impl RegularisedCoulomb {
    /// With a width w [rad/s], above 0.
    pub fn new(friction: Friction<f64>, slope: Slope, width_rad_per_s: f64) -> Self {
        Self { friction, slope, width_rad_per_s }
    }
}

impl FrictionLaw for RegularisedCoulomb {
    fn step(&mut self, scale: FrictionScale<f64>, velocity_rad_per_s: f64, _: f64) -> f64 {
        let ratio = velocity_rad_per_s / self.width_rad_per_s;
        let sign = match self.slope {
            Slope::Tanh => ratio.tanh(),
            Slope::Ramp => ratio.clamp(-1.0, 1.0),
        };
        level_v(&self.friction, scale, velocity_rad_per_s) * sign
            + viscous_v(&self.friction, scale, velocity_rad_per_s)
    }

    fn rest(&mut self) {}
}
