//! LuGre friction, eq. (9), over a step at constant velocity, and its derivatives.

use model::{Friction, FrictionState};

use super::parameters::FRICTION;

/// Step of the differences by a parameter's logarithm.
pub const NUDGE: f64 = 1e-5;

/// Mean voltage over a step and deflection at its end, or derivatives of both.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrictionStep {
    /// Mean voltage [V].
    pub voltage_v: f64,
    /// Deflection z of eq. (9) at the end [rad].
    pub deflection_rad: f64,
}

impl FrictionStep {
    /// A step from a deflection [rad] at a velocity [rad/s].
    pub fn over(friction: &Friction<f64>, z: f64, velocity: f64, step_s: f64) -> Self {
        let mut state = FrictionState { deflection_rad: z };
        let voltage_v = state.step(friction, velocity, step_s);
        Self { voltage_v, deflection_rad: state.deflection_rad }
    }

    /// (self - nominal) / nudge.
    fn difference_quotient(self, nominal: Self, nudge: f64) -> Self {
        Self {
            voltage_v: (self.voltage_v - nominal.voltage_v) / nudge,
            deflection_rad: (self.deflection_rad - nominal.deflection_rad) / nudge,
        }
    }

    fn scaled(self, factor: f64) -> Self {
        Self { voltage_v: self.voltage_v * factor, deflection_rad: self.deflection_rad * factor }
    }
}

/// A friction step with its derivatives, by forward differences.
pub struct FrictionJacobian {
    friction: Friction<f64>,
    begin_rad: f64,
    /// The step itself.
    pub nominal: FrictionStep,
    /// By the deflection at the beginning.
    pub by_deflection: FrictionStep,
    /// By the velocity.
    pub by_velocity: FrictionStep,
    by_level: FrictionStep,
    by_log_sigma0: FrictionStep,
}

impl FrictionJacobian {
    /// The step of `friction` from a deflection z [rad] at a velocity [rad/s]; `nudged` is
    /// the friction with alpha_0, and with sigma_0, times (1 + [`NUDGE`]).
    pub fn at(
        friction: &Friction<f64>,
        nudged: [&Friction<f64>; 2],
        z: f64,
        velocity: f64,
        step_s: f64,
    ) -> Self {
        let over = |friction, z, velocity| FrictionStep::over(friction, z, velocity, step_s);
        let nominal = over(friction, z, velocity);
        let by = |end: FrictionStep, nudge: f64| end.difference_quotient(nominal, nudge);
        let z_nudge = 1e-3 * friction.alpha0_v / friction.sigma0_v_per_rad;
        let v_nudge = 1e-4 * friction.stribeck_velocity_rad_per_s;
        Self {
            friction: *friction,
            begin_rad: z,
            nominal,
            by_deflection: by(over(friction, z + z_nudge, velocity), z_nudge),
            by_velocity: by(over(friction, z, velocity + v_nudge), v_nudge),
            by_level: by(over(nudged[0], z, velocity), NUDGE * friction.alpha0_v),
            by_log_sigma0: by(over(nudged[1], z, velocity), NUDGE),
        }
    }

    /// Derivatives by the parameters of [`super::parameters::to_logarithms`]. Those of the
    /// Stribeck curve, eq. (10), act through its level.
    pub fn by_parameter(&self, velocity: f64, step_s: f64) -> [FrictionStep; FRICTION] {
        let friction = &self.friction;
        let ratio = velocity / friction.stribeck_velocity_rad_per_s;
        let bell = (-ratio * ratio).exp();
        let breakaway_v = friction.alpha0_v + friction.alpha1_v;
        let travel_rad = self.nominal.deflection_rad - self.begin_rad;
        let voltage = |voltage_v: f64| FrictionStep { voltage_v, deflection_rad: 0.0 };
        [
            self.by_level.scaled(friction.alpha0_v * (1.0 - bell)),
            self.by_level.scaled(breakaway_v * bell),
            self.by_level.scaled(friction.alpha1_v * bell * 2.0 * ratio * ratio),
            voltage(friction.alpha2_v_s_per_rad * velocity),
            self.by_log_sigma0,
            voltage(friction.sigma1_v_s_per_rad * travel_rad / step_s),
        ]
    }
}
