//! Bounds of a block's values.

use model::ParameterError;
use model::parameter::named;

use super::parameters::{Gains, ParameterBlock};
use crate::compensation::ExternalLoad;
use crate::dac::FULL_SCALE_V;
use crate::encoder::COUNTS_PER_TURN;
use crate::mode::Mode;
use crate::reference::{FadeIn, Injection, Motion};

impl ParameterBlock {
    /// Checks every value of the block.
    ///
    /// # Errors
    /// Names the first value that is out of its bounds, and the joint.
    pub fn check(&self) -> Result<(), ParameterError> {
        self.robot.checked()?;
        self.check_board()?;
        for (joint, gains) in (1..).zip(&self.gains) {
            gains.check(joint)?;
        }
        for (joint, motion) in (1..).zip(&self.reference.motion) {
            motion.check(joint)?;
        }
        let rate_per_s = 1.0 / self.sample_period_s;
        for (joint, injection) in (1..).zip(&self.reference.injection) {
            injection.check(joint, rate_per_s)?;
        }
        named("duration_s", self.reference.duration_s).positive()?;
        for (joint, compensations) in (1..).zip(&self.compensations) {
            compensations.check(joint)?;
        }
        self.external_load.iter().try_for_each(ExternalLoad::check)?;
        self.check_unused()?;
        self.safety.check()
    }

    /// A joint that the rig does not have gets no voltage and has no range.
    fn check_unused(&self) -> Result<(), ParameterError> {
        let used = self.in_use.iter().filter(|used| **used).count();
        named("joints in use", used as f32).require(used > 0, "be one at least")?;
        for (joint, index) in (1..).zip(0..3).filter(|(_, index)| !self.in_use[*index]) {
            let is_off = self.mode[index] == Mode::OpenLoop
                && self.reference.injection[index] == Injection::None
                && self.safety.position[index].is_none();
            named("joint not in use", f32::from(joint))
                .of_joint(joint)
                .require(is_off, "be in open loop, without voltage and range")?;
        }
        Ok(())
    }

    fn check_board(&self) -> Result<(), ParameterError> {
        let counts = self.encoder_counts_per_turn;
        named("encoder_counts_per_rev", counts as f32)
            .require(COUNTS_PER_TURN.contains(&counts), "be from 64 to 2^24")?;
        let period_s = self.sample_period_s;
        named("sample_period_s", period_s)
            .require((1e-4..=1e-1).contains(&period_s), "be from 0.0001 to 0.1 s")?;
        let limit_v = self.command_limit_v;
        named("command_limit_V", limit_v)
            .require(limit_v > 0.0 && limit_v <= FULL_SCALE_V, "be above 0 and at most 10 V")?;
        for (joint, bandwidth) in (1..).zip(self.velocity_bandwidth_rad_per_s) {
            let named = named("velocity_bandwidth_rad_per_s", bandwidth).of_joint(joint);
            named.positive()?;
            named.require(bandwidth * period_s < 3.0, "be below 3 / sample period")?;
        }
        Ok(())
    }
}

impl Gains {
    fn check(&self, joint: u8) -> Result<(), ParameterError> {
        named("proportional_gain_V_per_rad", self.proportional_v_per_rad)
            .of_joint(joint)
            .not_negative()?;
        named("derivative_gain_V_s_per_rad", self.derivative_v_s_per_rad)
            .of_joint(joint)
            .not_negative()?;
        Ok(())
    }
}

/// Above this the resolution of an `f32` is coarser than an encoder count.
const LARGEST_ANGLE_RAD: f32 = 100.0;

fn check_angle(name: &'static str, joint: u8, angle_rad: f32) -> Result<(), ParameterError> {
    named(name, angle_rad)
        .of_joint(joint)
        .require(angle_rad.abs() <= LARGEST_ANGLE_RAD, "be within 100 rad")?;
    Ok(())
}

fn check_duration(name: &'static str, joint: u8, duration_s: f32) -> Result<(), ParameterError> {
    named(name, duration_s).of_joint(joint).positive()?;
    Ok(())
}

impl FadeIn {
    fn check(&self, joint: u8) -> Result<(), ParameterError> {
        named("fade_in", self.duration_s).of_joint(joint).not_negative()?;
        Ok(())
    }
}

impl Motion {
    fn check(&self, joint: u8) -> Result<(), ParameterError> {
        match self {
            Self::Hold { angle_rad } => check_angle("angle_rad", joint, *angle_rad),
            Self::Quintic { from_rad, to_rad, duration_s } => {
                check_angle("from_rad", joint, *from_rad)?;
                check_angle("to_rad", joint, *to_rad)?;
                check_duration("duration_s", joint, *duration_s)
            }
            Self::Sine(sine) => {
                check_angle("centre_rad", joint, sine.centre_rad)?;
                check_angle("amplitude_rad", joint, sine.amplitude_rad)?;
                check_duration("period_s", joint, sine.period_s)?;
                sine.fade_in.check(joint)
            }
            Self::Fourier(series) => {
                check_angle("centre_rad", joint, series.centre_rad)?;
                for amplitude_rad in series.sine_rad.iter().chain(&series.cosine_rad) {
                    check_angle("Fourier amplitude_rad", joint, *amplitude_rad)?;
                }
                check_duration("period_s", joint, series.period_s)?;
                series.fade_in.check(joint)
            }
            Self::ConstantVelocity(legs) => {
                check_angle("start_rad", joint, legs.start_rad)?;
                check_duration("leg_s", joint, legs.leg_s)?;
                check_duration("ramp_s", joint, legs.ramp_s)?;
                named("ramp_s", legs.ramp_s)
                    .of_joint(joint)
                    .require(2.0 * legs.ramp_s <= legs.leg_s, "be at most half of leg_s")?;
                for speed in &legs.speeds_rad_per_s {
                    check_angle("leg's travel_rad", joint, speed * legs.leg_s)?;
                }
                Ok(())
            }
        }
    }
}

impl Injection {
    fn check(&self, joint: u8, rate_per_s: f32) -> Result<(), ParameterError> {
        let check_voltage = |name, voltage_v: f32| {
            named(name, voltage_v)
                .of_joint(joint)
                .require(voltage_v.abs() <= FULL_SCALE_V, "be within 10 V")
        };
        match self {
            Self::None => {}
            Self::FrictionExcitation(excitation) => {
                check_voltage("first_amplitude_V", excitation.first_amplitude_v)?;
                check_voltage("last_amplitude_V", excitation.last_amplitude_v)?;
                check_duration("growth_s", joint, excitation.growth_s)?;
                check_duration("slow_period_s", joint, excitation.slow_period_s)?;
                check_duration("fast_period_s", joint, excitation.fast_period_s)?;
            }
            Self::Noise(noise) => {
                check_voltage("noise rms_V", noise.rms_v)?;
                let share = noise.bandwidth_hz / rate_per_s;
                named("noise bandwidth_Hz", noise.bandwidth_hz)
                    .of_joint(joint)
                    .require((0.01..0.49).contains(&share), "be 0.01 to 0.49 of the sample rate")?;
            }
        }
        Ok(())
    }
}
