//! The range of a joint, and how fast it can be brought to rest at its ends.

use model::ParameterError;
use model::parameter::named;
use serde::{Deserialize, Serialize};

/// The range that a joint must not leave while it runs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PositionLimits {
    /// Lower end [rad].
    pub lower_rad: f32,
    /// Upper end [rad].
    pub upper_rad: f32,
    /// What the joint can be decelerated with [rad/s^2].
    pub braking_rad_per_s2: f32,
}

/// No joint has a range beyond [rad]; an `f32` there is exact to 0.1 mrad.
const FURTHEST_RAD: f32 = 1_000.0;

impl PositionLimits {
    /// Checks that the ends are in order and that the joint can be decelerated.
    pub fn check(&self, joint: u8) -> Result<(), ParameterError> {
        let within = |end: f32| (-FURTHEST_RAD..=FURTHEST_RAD).contains(&end);
        named("lower position limit_rad", self.lower_rad)
            .of_joint(joint)
            .require(within(self.lower_rad), "be from -1000 to 1000 rad")?;
        named("upper position limit_rad", self.upper_rad).of_joint(joint).require(
            within(self.upper_rad) && self.upper_rad > self.lower_rad,
            "be above the lower one and at most 1000 rad",
        )?;
        named("braking_rad_per_s2", self.braking_rad_per_s2).of_joint(joint).positive()?;
        Ok(())
    }

    /// Whether the range lies within another one.
    pub fn is_within(&self, other: &Self) -> bool {
        self.lower_rad >= other.lower_rad && self.upper_rad <= other.upper_rad
    }
}
