//! The limits at which the supervisor ends a run.

use model::ParameterError;
use model::parameter::named;
use serde::{Deserialize, Serialize};

use super::motor_heating::MotorHeating;
use super::position_limits::PositionLimits;

/// The limits of a parameter block; exceeding one is a fault.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SafetyLimits {
    /// Speed limit of each joint [rad/s].
    pub speed_rad_per_s: [f32; 3],
    /// Tracking error limit of each joint [rad].
    pub tracking_error_rad: [f32; 3],
    /// Acceleration limit [rad/s^2], above what the motor or a person can cause: a larger one
    /// is an encoder error.
    pub acceleration_rad_per_s2: [f32; 3],
    /// Longest uninterrupted saturation of a command [s].
    pub saturation_s: f32,
    /// Largest travel of the reference while the encoder does not move [rad].
    pub stuck_travel_rad: f32,
    /// Largest open-loop command while the encoder does not move [V],
    pub stuck_voltage_v: f32,
    /// and the time for which a larger one is accepted [s].
    pub stuck_s: f32,
    /// Largest distance of each joint from the reference's start at which a run may begin [rad].
    pub start_error_rad: [f32; 3],
    /// Voltage beyond gravity and twice the static friction at which a tracked joint may stand
    /// still [V],
    pub stalled_margin_v: f32,
    /// and the time for which a larger one is accepted [s].
    pub stalled_s: f32,
    /// Longest time for which joints are held after their reference has ended [s].
    pub hold_s: f32,
    /// Range of each joint; `None` where it may turn without end.
    pub position: [Option<PositionLimits>; 3],
    /// What each motor bears; `None` where nobody has told.
    pub heating: [Option<MotorHeating>; 3],
}

impl Default for SafetyLimits {
    /// Wide enough for the motions of the paper, narrow enough to detect a broken wire.
    fn default() -> Self {
        Self {
            speed_rad_per_s: [15.0; 3],
            tracking_error_rad: [0.5; 3],
            acceleration_rad_per_s2: [5_000.0; 3],
            saturation_s: 0.5,
            stuck_travel_rad: 0.05,
            stuck_voltage_v: 3.0,
            stuck_s: 0.2,
            // What an arm sags by after an approach; at 80 V/rad it is worth 4 V, faded in.
            start_error_rad: [0.05; 3],
            // Above what the torque constant and gravity of a first model file are wrong by.
            stalled_margin_v: 1.0,
            // As long as a saturation.
            stalled_s: 0.5,
            // A host ends a run within a second; a person has time to support the arm.
            hold_s: 30.0,
            position: [None; 3],
            heating: [None; 3],
        }
    }
}

impl SafetyLimits {
    /// Checks that each limit is finite and above zero.
    pub fn check(&self) -> Result<(), ParameterError> {
        for joint in 0..3 {
            let number = joint as u8 + 1;
            let of = |name, value: f32| named(name, value).of_joint(number).positive();
            of("speed_limit_rad_per_s", self.speed_rad_per_s[joint])?;
            of("tracking_error_limit_rad", self.tracking_error_rad[joint])?;
            of("acceleration_limit_rad_per_s2", self.acceleration_rad_per_s2[joint])?;
            self.position[joint].iter().try_for_each(|range| range.check(number))?;
            self.heating[joint].iter().try_for_each(|motor| motor.check(number))?;
            of("start_error_limit_rad", self.start_error_rad[joint])?;
        }
        named("saturation_limit_s", self.saturation_s).positive()?;
        named("stuck_travel_rad", self.stuck_travel_rad).positive()?;
        named("stuck_voltage_V", self.stuck_voltage_v).positive()?;
        named("stuck_s", self.stuck_s).positive()?;
        named("stalled_margin_V", self.stalled_margin_v).positive()?;
        named("stalled_s", self.stalled_s).positive()?;
        named("hold_s", self.hold_s).positive()?;
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
