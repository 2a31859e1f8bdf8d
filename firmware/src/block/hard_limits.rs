//! The board's own limits, which no parameter block may exceed.

use model::ParameterError;
use model::parameter::named;

use super::motor_heating::MotorHeating;
use super::parameters::ParameterBlock;
use super::position_limits::PositionLimits;
use super::rig_ranges;
use crate::dac::FULL_SCALE_V;

/// The limits that no parameter block may exceed on a board, whoever sends it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HardLimits {
    /// The board's sample period [s]; a block with another one is refused.
    pub sample_period_s: f32,
    /// Largest command [V].
    pub command_v: f32,
    /// Highest speed limit that a block may set [rad/s].
    pub speed_rad_per_s: f32,
    /// Largest tracking error limit that a block may set [rad].
    pub tracking_error_rad: f32,
    /// Largest distance from the reference's start that a block may allow [rad].
    pub start_error_rad: f32,
    /// Largest acceleration limit that a block may set [rad/s^2].
    pub acceleration_rad_per_s2: f32,
    /// Longest saturation limit that a block may set [s].
    pub saturation_s: f32,
    /// Largest `stuck_travel_rad` that a block may set [rad].
    pub stuck_travel_rad: f32,
    /// Largest `stuck_voltage_v` that a block may set [V].
    pub stuck_voltage_v: f32,
    /// Longest `stuck_s` that a block may set [s].
    pub stuck_s: f32,
    /// Largest `stalled_margin_v` that a block may set [V].
    pub stalled_margin_v: f32,
    /// Longest `stalled_s` that a block may set [s].
    pub stalled_s: f32,
    /// Longest `hold_s` that a block may set [s].
    pub hold_s: f32,
    /// Longest silence of a host in a run, whatever it asks for [s].
    pub host_silence_s: f32,
    /// The range of each joint of the rig, within which a block's must lie; `None`: any.
    pub position: [Option<PositionLimits>; 3],
    /// What each motor of the rig bears, above which no block may go; `None`: unknown.
    pub heating: [Option<MotorHeating>; 3],
    /// Largest difference of a measured output from its code, where outputs are measured [V],
    pub output_error_v: f32,
    /// and for so many ticks on end a larger one is accepted.
    pub output_error_ticks: u32,
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
            // As far as a person sees the arm move and is not hit by it.
            start_error_rad: 0.1,
            acceleration_rad_per_s2: 50_000.0,
            saturation_s: 5.0,
            stuck_travel_rad: 0.5,
            stuck_voltage_v: 9.0,
            stuck_s: 2.0,
            stalled_margin_v: 5.0,
            stalled_s: 2.0,
            hold_s: 300.0,
            // A host asks ten times a second; a person reaches the emergency stop.
            host_silence_s: 10.0,
            position: [None; 3],
            heating: [None; 3],
            // Resistors of 1 % and a supply of 2 % are 0.53 V off at 10 V: `crate::loopback`.
            output_error_v: 0.75,
            // A disturbed sample or two stop nothing; a joint at 10 V moves 0.3 mrad in 5 ms.
            output_error_ticks: 4,
            proportional_gain_v_per_rad: 10_000.0,
            derivative_gain_v_s_per_rad: 500.0,
        }
    }
}

impl HardLimits {
    /// The limits of the rig that this image was built for: [`Self::default`], and the ranges that
    /// `RRR_RIG_RANGES_RAD` named at the build.
    pub fn of_rig() -> Self {
        Self { position: rig_ranges::of_this_build(), ..Self::default() }
    }

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
        below("stalled_margin_V", safety.stalled_margin_v, self.stalled_margin_v)?;
        below("stalled_s", safety.stalled_s, self.stalled_s)?;
        below("hold_s", safety.hold_s, self.hold_s)?;
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
        below("start_error_limit_rad", safety.start_error_rad[joint], self.start_error_rad)?;
        if let Some(widest) = self.position[joint].as_ref().filter(|_| block.in_use[joint]) {
            let range = safety.position[joint];
            named("position limits_rad", range.map_or(f32::INFINITY, |range| range.upper_rad))
                .of_joint(joint as u8 + 1)
                .require(range.is_some_and(|range| range.is_within(widest)), WITHIN)?;
        }
        if let Some(most) = &self.heating[joint] {
            let motor = safety.heating[joint];
            named("motor continuous_V", motor.map_or(f32::INFINITY, |motor| motor.continuous_v))
                .of_joint(joint as u8 + 1)
                .require(motor.is_some_and(|motor| motor.bears_less_than(most)), BELOW)?;
        }
        let acceleration = safety.acceleration_rad_per_s2[joint];
        below("acceleration_limit_rad_per_s2", acceleration, self.acceleration_rad_per_s2)?;
        Ok(())
    }
}

const WITHIN: &str = "lie within the rig's hard limits";
const BELOW: &str = "not exceed the board's hard limit";
