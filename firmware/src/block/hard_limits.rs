//! What the board allows a parameter block to set, whoever sends it.

use model::ParameterError;
use model::parameter::named;

use super::parameters::ParameterBlock;
use crate::dac::FULL_SCALE_V;

/// What no parameter block may exceed on a board, whoever sends it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HardLimits {
    /// The board's time from tick to tick [s]; a block for another one is refused.
    pub sample_period_s: f32,
    /// Largest command [V].
    pub command_v: f32,
    /// Highest speed limit that a block may set [rad/s].
    pub speed_rad_per_s: f32,
    /// Widest tracking error that a block may allow [rad].
    pub tracking_error_rad: f32,
    /// Most that a block may take for possible [rad/s^2].
    pub acceleration_rad_per_s2: f32,
    /// Longest saturation that a block may allow [s].
    pub saturation_s: f32,
    /// Furthest that a block may let a reference go while the encoder stands still [rad].
    pub stuck_travel_rad: f32,
    /// Largest voltage that a block may put on a joint whose encoder stands still [V],
    pub stuck_voltage_v: f32,
    /// and longest time for more [s].
    pub stuck_s: f32,
    /// Largest proportional gain [V/rad].
    pub proportional_gain_v_per_rad: f32,
    /// Largest derivative gain [V s/rad].
    pub derivative_gain_v_s_per_rad: f32,
}

impl Default for HardLimits {
    fn default() -> Self {
        Self {
            sample_period_s: 1e-3,
            command_v: FULL_SCALE_V,
            speed_rad_per_s: 30.0,
            // Half a turn could never be exceeded.
            tracking_error_rad: 2.0,
            acceleration_rad_per_s2: 50_000.0,
            saturation_s: 5.0,
            stuck_travel_rad: 0.5,
            stuck_voltage_v: 9.0,
            stuck_s: 2.0,
            proportional_gain_v_per_rad: 10_000.0,
            derivative_gain_v_s_per_rad: 500.0,
        }
    }
}

impl HardLimits {
    /// Checks a block, which has passed its own check, against the board.
    pub fn check(&self, block: &ParameterBlock) -> Result<(), ParameterError> {
        let period_s = block.sample_period_s;
        named("sample_period_s", period_s).require(
            (period_s - self.sample_period_s).abs() <= 1e-6 * self.sample_period_s,
            "be the board's, 0.001 s",
        )?;
        named("command_limit_V", block.command_limit_v)
            .require(block.command_limit_v <= self.command_v, BELOW)?;
        let below = |name, value: f32, most: f32| named(name, value).require(value <= most, BELOW);
        let safety = &block.safety;
        below("saturation_limit_s", safety.saturation_s, self.saturation_s)?;
        below("stuck_travel_rad", safety.stuck_travel_rad, self.stuck_travel_rad)?;
        below("stuck_voltage_V", safety.stuck_voltage_v, self.stuck_voltage_v)?;
        below("stuck_s", safety.stuck_s, self.stuck_s)?;
        (0..3).try_for_each(|joint| self.check_joint(block, joint))
    }

    fn check_joint(&self, block: &ParameterBlock, joint: usize) -> Result<(), ParameterError> {
        let below = |name, value: f32, most: f32| {
            named(name, value).of_joint(joint as u8 + 1).require(value <= most, BELOW)
        };
        let (gains, safety) = (&block.gains[joint], &block.safety);
        let (kp, kd) = (gains.proportional_v_per_rad, gains.derivative_v_s_per_rad);
        below("proportional_gain_V_per_rad", kp, self.proportional_gain_v_per_rad)?;
        below("derivative_gain_V_s_per_rad", kd, self.derivative_gain_v_s_per_rad)?;
        let (speed, error) = (safety.speed_rad_per_s[joint], safety.tracking_error_rad[joint]);
        below("speed_limit_rad_per_s", speed, self.speed_rad_per_s)?;
        below("tracking_error_limit_rad", error, self.tracking_error_rad)?;
        let acceleration = safety.acceleration_rad_per_s2[joint];
        below("acceleration_limit_rad_per_s2", acceleration, self.acceleration_rad_per_s2)?;
        Ok(())
    }
}

const BELOW: &str = "not exceed the board's hard limit";
