//! Angles that never lose precision, however many turns the joint makes.

use core::f32::consts::TAU;

use serde::{Deserialize, Serialize};

/// An angle in 1/2^32 of a turn (1.5 nrad), wrapping at the turn.
///
/// An `f32` in radians has less than an encoder count of precision after 20 turns;
/// this has the same everywhere. Differences are taken before anything becomes `f32`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Angle(pub i32);

impl Angle {
    /// Radians per unit.
    pub const RADIANS_PER_UNIT: f32 = TAU / 4_294_967_296.0;

    /// The angle of so many radians, of either sign and of any number of turns.
    #[inline]
    pub fn from_radians(angle_rad: f32) -> Self {
        let turns = angle_rad * (1.0 / TAU);
        let fraction = turns - (turns as i32) as f32;
        Self(((fraction * 2_147_483_648.0) as i32).wrapping_shl(1))
    }

    /// The sum of this angle and a small one in radians, to within one unit.
    #[inline]
    pub fn plus(self, small_rad: f32) -> Self {
        Self(self.0.wrapping_add((small_rad * (1.0 / Self::RADIANS_PER_UNIT)) as i32))
    }

    /// This angle minus `other`, the shorter of the two differences, in [-pi, pi) [rad].
    #[inline]
    pub fn minus(self, other: Self) -> f32 {
        self.0.wrapping_sub(other.0) as f32 * Self::RADIANS_PER_UNIT
    }

    /// The nearest count within half a turn of zero, of an encoder with so many counts a turn.
    pub fn in_counts(self, counts_per_turn: u32) -> i32 {
        let product = i64::from(self.0) * i64::from(counts_per_turn);
        ((product + (1 << 31)) >> 32) as i32
    }

    /// Sine and cosine.
    #[inline]
    pub fn sin_cos(self) -> (f32, f32) {
        model::trigonometry::sin_cos_turn(self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radians_go_in_and_come_out() {
        for angle_rad in [-3.1_f32, -1.0, -1e-3, 0.0, 0.5, 3.1] {
            let error = Angle::from_radians(angle_rad).minus(Angle::default()) - angle_rad;
            assert!(error.abs() < 5e-7, "{angle_rad}: {error:e}");
        }
    }

    #[test]
    fn an_angle_is_the_nearest_count() {
        for (angle_rad, count) in [(0.0, 0), (1e-5, 1), (-1e-5, -1), (-TAU / 4.0, -163_840)] {
            assert_eq!(Angle::from_radians(angle_rad).in_counts(655_360), count);
        }
    }

    #[test]
    fn whole_turns_vanish() {
        let error = Angle::from_radians(TAU * 7.0 + 0.25).minus(Angle::from_radians(0.25));
        assert!(error.abs() < 5e-6, "{error:e}");
    }

    #[test]
    fn differences_take_the_shorter_way() {
        let error = Angle::from_radians(3.1).minus(Angle::from_radians(-3.1));
        assert!((error - (6.2 - TAU)).abs() < 1e-6, "{error}");
    }
}
