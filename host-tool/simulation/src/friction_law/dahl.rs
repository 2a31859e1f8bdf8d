//! Dahl's friction: a bristle that yields at the Coulomb level, without Stribeck curve or damping.

use model::FrictionState;
use model::friction::{Friction, FrictionScale};

use super::law::FrictionLaw;

/// z' = v - sigma0 |v| z / alpha0, friction sigma0 z + alpha2 v.
#[derive(Clone, Copy, Debug)]
pub struct Dahl {
    friction: Friction<f64>,
    state: FrictionState<f64>,
}

impl Dahl {
    /// With a stiffness at rest [V/rad], above 0.
    pub fn new(friction: Friction<f64>, stiffness_v_per_rad: f64) -> Self {
        let friction = Friction {
            alpha1_v: 0.0,
            sigma0_v_per_rad: stiffness_v_per_rad,
            sigma1_v_s_per_rad: 0.0,
            ..friction
        };
        Self { friction, state: FrictionState::default() }
    }
}

impl FrictionLaw for Dahl {
    fn step(&mut self, scale: FrictionScale<f64>, velocity_rad_per_s: f64, step_s: f64) -> f64 {
        self.state.step_scaled(&self.friction, scale, velocity_rad_per_s, step_s)
    }

    fn rest(&mut self) {
        self.state = FrictionState::default();
    }
}
