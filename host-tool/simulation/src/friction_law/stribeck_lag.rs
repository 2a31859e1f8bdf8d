//! Stribeck friction that follows the speed late, as a film of oil does (Hess and Soom, 1990).

use model::FrictionState;
use model::friction::{Friction, FrictionScale};

use super::law::{FrictionLaw, level_v};

/// A bristle whose level is gamma of the speed as it was: T s' = |v| - s.
#[derive(Clone, Copy, Debug)]
pub struct StribeckLag {
    friction: Friction<f64>,
    lag_s: f64,
    late_speed_rad_per_s: f64,
    state: FrictionState<f64>,
}

impl StribeckLag {
    /// With a lag T [s], above 0, and another Stribeck velocity [rad/s], above 0.
    pub fn new(friction: Friction<f64>, lag_s: f64, stribeck_velocity_rad_per_s: f64) -> Self {
        let friction = Friction { stribeck_velocity_rad_per_s, ..friction };
        Self { friction, lag_s, late_speed_rad_per_s: 0.0, state: FrictionState::default() }
    }
}

impl FrictionLaw for StribeckLag {
    fn step(&mut self, scale: FrictionScale<f64>, velocity_rad_per_s: f64, step_s: f64) -> f64 {
        let behind = velocity_rad_per_s.abs() - self.late_speed_rad_per_s;
        self.late_speed_rad_per_s -= behind * (-step_s / self.lag_s).exp_m1();
        let level_v = level_v(&self.friction, scale, self.late_speed_rad_per_s);
        let bristle = Friction { alpha0_v: level_v.max(1e-6), alpha1_v: 0.0, ..self.friction };
        let scale = FrictionScale { level: 1.0, added_v: 0.0, ..scale };
        self.state.step_scaled(&bristle, scale, velocity_rad_per_s, step_s)
    }

    fn rest(&mut self) {
        (self.state, self.late_speed_rad_per_s) = (FrictionState::default(), 0.0);
    }
}
