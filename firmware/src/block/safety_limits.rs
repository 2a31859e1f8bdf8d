//! How far the joints may go before the supervisor ends a run.

use model::ParameterError;
use model::parameter::named;
use serde::{Deserialize, Serialize};

/// The limits of a parameter block; beyond one of them is a fault.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SafetyLimits {
    /// Fastest that each joint may be [rad/s].
    pub speed_rad_per_s: [f32; 3],
    /// Furthest that each joint may be from its reference [rad]; also from where it begins.
    pub tracking_error_rad: [f32; 3],
    /// More than any joint can accelerate, pushed by the motor or by a person [rad/s^2].
    pub acceleration_rad_per_s2: [f32; 3],
    /// Longest that a command may stay at its limit without a pause [s].
    pub saturation_s: f32,
    /// So far may a reference go while the encoder stands still [rad].
    pub stuck_travel_rad: f32,
    /// So much voltage may an open-loop command have while the encoder stands still [V],
    pub stuck_voltage_v: f32,
    /// for so long [s].
    pub stuck_s: f32,
}

impl Default for SafetyLimits {
    /// Wide enough for the motions of the paper, narrow enough for a broken wire.
    fn default() -> Self {
        Self {
            speed_rad_per_s: [15.0; 3],
            tracking_error_rad: [0.5; 3],
            acceleration_rad_per_s2: [5_000.0; 3],
            saturation_s: 0.5,
            stuck_travel_rad: 0.05,
            stuck_voltage_v: 3.0,
            stuck_s: 0.2,
        }
    }
}

impl SafetyLimits {
    /// Checks that each limit is one.
    pub fn check(&self) -> Result<(), ParameterError> {
        for joint in 0..3 {
            let number = joint as u8 + 1;
            let of = |name, value: f32| named(name, value).of_joint(number).positive();
            of("speed_limit_rad_per_s", self.speed_rad_per_s[joint])?;
            of("tracking_error_limit_rad", self.tracking_error_rad[joint])?;
            of("acceleration_limit_rad_per_s2", self.acceleration_rad_per_s2[joint])?;
        }
        named("saturation_limit_s", self.saturation_s).positive()?;
        named("stuck_travel_rad", self.stuck_travel_rad).positive()?;
        named("stuck_voltage_V", self.stuck_voltage_v).positive()?;
        named("stuck_s", self.stuck_s).positive()?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_that_are_none_are_refused() {
        let mut limits = SafetyLimits::default();
        limits.speed_rad_per_s[2] = 0.0;
        assert_eq!(limits.check().unwrap_err().name, "speed_limit_rad_per_s");
        let limits = SafetyLimits { saturation_s: f32::NAN, ..SafetyLimits::default() };
        assert_eq!(limits.check().unwrap_err().name, "saturation_limit_s");
    }
}
