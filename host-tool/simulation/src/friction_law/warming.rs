//! Friction that falls as its own work warms the joint, of whatever law.

use model::FrictionState;
use model::friction::FrictionScale;

use super::law::FrictionLaw;

/// How a joint warms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Warmth {
    /// By which part Coulomb and viscous friction fall when warm, 0 to 1.
    pub fall: f64,
    /// Time constant of warming and cooling [s].
    pub time_constant_s: f64,
    /// Power of friction [V rad/s] at which 63 % of the fall are reached in the long run.
    pub power_v_rad_per_s: f64,
}

/// Another law, less by fall (1 - exp(-w)): T w' = |F v| / P - w. Stays warm from log to log.
#[derive(Debug)]
pub struct Warming {
    law: Box<dyn FrictionLaw>,
    warmth: Warmth,
    state: f64,
}

impl Warming {
    /// A cold joint.
    pub fn new(law: Box<dyn FrictionLaw>, warmth: Warmth) -> Self {
        Self { law, warmth, state: 0.0 }
    }

    /// The factor on Coulomb and viscous friction, 1 when cold.
    pub fn factor(&self) -> f64 {
        1.0 + self.warmth.fall * (-self.state).exp_m1()
    }
}

impl FrictionLaw for Warming {
    fn step(&mut self, scale: FrictionScale<f64>, velocity_rad_per_s: f64, step_s: f64) -> f64 {
        let factor = self.factor();
        let FrictionScale { level, added_v, viscous } = scale;
        let warm = FrictionScale {
            level: level * factor,
            added_v: added_v * factor,
            viscous: viscous * factor,
        };
        let friction_v = self.law.step(warm, velocity_rad_per_s, step_s);
        let power = (friction_v * velocity_rad_per_s).abs() / self.warmth.power_v_rad_per_s;
        let steps = step_s / self.warmth.time_constant_s;
        self.state -= (power - self.state) * (-steps).exp_m1();
        friction_v
    }

    fn rest(&mut self) {
        self.law.rest();
    }

    fn set_bristles(&mut self, state: FrictionState<f64>) {
        self.law.set_bristles(state);
    }
}
