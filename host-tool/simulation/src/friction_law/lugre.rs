//! LuGre friction, eq. (9)-(10): the paper's, and the default.

use model::FrictionState;
use model::friction::{Friction, FrictionScale};

use super::law::FrictionLaw;

/// LuGre friction with its state.
#[derive(Clone, Copy, Debug)]
pub struct LuGre {
    friction: Friction<f64>,
    state: FrictionState<f64>,
}

impl LuGre {
    /// Bristles without deflection.
    pub fn new(friction: Friction<f64>) -> Self {
        Self { friction, state: FrictionState::default() }
    }
}

impl FrictionLaw for LuGre {
    fn step(&mut self, scale: FrictionScale<f64>, velocity_rad_per_s: f64, step_s: f64) -> f64 {
        self.state.step_scaled(&self.friction, scale, velocity_rad_per_s, step_s)
    }

    fn rest(&mut self) {
        self.state = FrictionState::default();
    }

    fn set_bristles(&mut self, state: FrictionState<f64>) {
        self.state = state;
    }
}
