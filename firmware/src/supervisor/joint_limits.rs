//! The limits of a joint in the units in which each tick compares them.

use core::f32::consts::TAU;

use crate::{Angle, ParameterBlock};

/// Dither of an encoder at a joint at rest, and about a smooth motion [counts].
pub(super) const DITHER_COUNTS: u32 = 3;

/// A tick at the limit counts as many of those below it, so that no limit cycle with a fifth of
/// its ticks at the limit goes on.
pub(super) const SATURATION_WEIGHT: u32 = 4;

/// The limits of one joint, in the units in which they are compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Limits {
    pub jump_counts: u32,
    pub speed_rad_per_s: f32,
    pub tracking_error_rad: f32,
    /// As many units off the reference are more than that; none is where there is no reference.
    pub far_units: u32,
    pub saturated_quarters: u32,
    pub stuck_travel_rad: f32,
    pub stuck_voltage_v: f32,
    pub stuck_ticks: u32,
}

impl Limits {
    pub fn of(block: &ParameterBlock, index: usize, has_reference: bool) -> Self {
        let (safety, period_s) = (&block.safety, block.sample_period_s);
        let counts_per_radian = block.encoder_counts_per_turn as f32 / TAU;
        let acceleration = safety.acceleration_rad_per_s2[index];
        let jump = acceleration * period_s * period_s * counts_per_radian;
        Self {
            // Converting to integers saturates.
            jump_counts: (jump as u32).saturating_add(DITHER_COUNTS),
            speed_rad_per_s: safety.speed_rad_per_s[index],
            tracking_error_rad: safety.tracking_error_rad[index],
            far_units: match has_reference {
                true => units_beyond(safety.tracking_error_rad[index]),
                false => u32::MAX,
            },
            saturated_quarters: ((safety.saturation_s / period_s + 0.5) as u32)
                .saturating_mul(SATURATION_WEIGHT),
            stuck_travel_rad: safety.stuck_travel_rad,
            // Commands that are cut below that must not hide a dead encoder.
            stuck_voltage_v: safety.stuck_voltage_v.min(0.9 * block.command_limit_v),
            stuck_ticks: (safety.stuck_s / period_s + 0.5) as u32,
        }
    }
}

impl Limits {
    /// Whether a joint may be so fast; a NaN is not.
    #[inline(always)]
    pub fn allow_speed(&self, velocity_rad_per_s: f32) -> bool {
        velocity_rad_per_s.abs() <= self.speed_rad_per_s
    }
}

/// The fewest units of an [`Angle`] that are more than `limit_rad`, as [`Angle::minus`] rounds.
fn units_beyond(limit_rad: f32) -> u32 {
    let (mut within, mut beyond) = (0_u32, u32::MAX);
    while beyond - within > 1 {
        let middle = within + (beyond - within) / 2;
        // More than half a turn there is not.
        let is_within = middle > 1 << 31 || middle as f32 * Angle::RADIANS_PER_UNIT <= limit_rad;
        (within, beyond) = if is_within { (middle, beyond) } else { (within, middle) };
    }
    beyond
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_units_are_too_far_as_radians_say() {
        for limit_rad in [1e-4_f32, 0.05, 0.5, 1.0, 3.0, 3.141_592_5] {
            let units = units_beyond(limit_rad);
            let radians = |units: u32| (units as f32 * Angle::RADIANS_PER_UNIT).abs();
            assert!(radians(units) > limit_rad && radians(units - 1) <= limit_rad, "{limit_rad}");
        }
        assert!(units_beyond(4.0) > 1 << 31, "more than half a turn there is not");
    }
}
