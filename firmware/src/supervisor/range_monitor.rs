//! A joint that would leave its range: found while it can still be braked.

use core::f32::consts::TAU;

use crate::ParameterBlock;
use crate::block::PositionLimits;
use crate::joint::JointSample;
use crate::reference::braking_distance_rad;

/// A joint's range and how it is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RangeMonitor {
    limits: Option<PositionLimits>,
    radians_per_count: f32,
}

impl RangeMonitor {
    /// For joint `index` (0 to 2) of a checked block.
    pub fn new(block: &ParameterBlock, index: usize) -> Self {
        let radians_per_count = TAU / block.encoder_counts_per_turn as f32;
        Self { limits: block.safety.position[index], radians_per_count }
    }

    /// Whether the joint has a range, so that its position must be known.
    pub fn is_there(&self) -> bool {
        self.limits.is_some()
    }

    /// Where the joint would come to rest, and the end of the range beyond which that is [rad].
    #[inline]
    pub fn leaves(&self, count: i32, velocity_rad_per_s: f32) -> Option<(f32, f32)> {
        let limits = self.limits.as_ref()?;
        let position_rad = count as f32 * self.radians_per_count;
        let distance_rad = braking_distance_rad(velocity_rad_per_s, limits.braking_rad_per_s2);
        if velocity_rad_per_s > 0.0 && position_rad + distance_rad > limits.upper_rad {
            Some((position_rad + distance_rad, limits.upper_rad))
        } else if velocity_rad_per_s < 0.0 && position_rad - distance_rad < limits.lower_rad {
            Some((position_rad - distance_rad, limits.lower_rad))
        } else {
            None
        }
    }

    /// Whether the joint would leave its range.
    #[inline]
    pub fn is_left_by(&self, sample: &JointSample) -> bool {
        self.leaves(sample.count, sample.velocity_rad_per_s).is_some()
    }

    /// The position and the end of the range that it is beyond [rad].
    pub fn outside(&self, count: i32) -> Option<(f32, f32)> {
        let limits = self.limits.as_ref()?;
        let position_rad = count as f32 * self.radians_per_count;
        if position_rad > limits.upper_rad {
            Some((position_rad, limits.upper_rad))
        } else if position_rad < limits.lower_rad {
            Some((position_rad, limits.lower_rad))
        } else {
            None
        }
    }
}
