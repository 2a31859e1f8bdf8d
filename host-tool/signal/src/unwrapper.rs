//! Angles that wrap, made whole again.

use std::f64::consts::TAU;

/// A turn in units of a wrapping angle.
const TURN: f64 = 4_294_967_296.0;

/// Follows an angle that wraps, in units of 2^-32 turns, over any number of turns.
#[derive(Clone, Copy, Debug)]
pub struct Unwrapper {
    last: i32,
    turns_in_units: i64,
}

impl Unwrapper {
    /// Begins on the turn where the angle is nearest to `near_rad`.
    pub fn near(angle: i32, near_rad: f64) -> Self {
        let wanted = near_rad / TAU * TURN;
        let turns = ((wanted - f64::from(angle)) / TURN).round() as i64;
        Self { last: angle, turns_in_units: (turns << 32) + i64::from(angle) }
    }

    /// The angle in radians, whole turns counted [rad].
    pub fn update(&mut self, angle: i32) -> f64 {
        self.turns_in_units += i64::from(angle.wrapping_sub(self.last));
        self.last = angle;
        self.turns_in_units as f64 * (TAU / TURN)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_counted() {
        let path = (0..1000).map(|k| 20.0 + 0.03 * f64::from(k));
        let wrapped = |q: f64| (q / TAU * TURN).round() as i64 as i32;
        let mut unwrapper = Unwrapper::near(wrapped(20.0), 20.0);
        for q in path {
            let error = unwrapper.update(wrapped(q)) - q;
            assert!(error.abs() < 2e-9, "{error:e}");
        }
    }
}
