//! What the encoders see, and angles that wrap made whole again.

use std::f64::consts::TAU;

use firmware::Angle;
use model::vector::Vector3;

/// Encoder counts of joint angles, the nearest count each.
pub fn counts(q_rad: &Vector3<f64>, counts_per_turn: u32) -> [i64; 3] {
    q_rad.map(|q| (q / TAU * f64::from(counts_per_turn)).round() as i64)
}

/// Follows a wrapping [`Angle`] over any number of turns.
#[derive(Clone, Copy, Debug)]
pub struct Unwrapper {
    last: Angle,
    turns_in_units: i64,
}

impl Unwrapper {
    /// Begins on the turn where the angle is nearest to `near_rad`.
    pub fn near(angle: Angle, near_rad: f64) -> Self {
        let wanted = near_rad / TAU * 2f64.powi(32);
        let turns = ((wanted - f64::from(angle.0)) / 2f64.powi(32)).round() as i64;
        Self { last: angle, turns_in_units: (turns << 32) + i64::from(angle.0) }
    }

    /// The angle in radians, whole turns counted [rad].
    pub fn update(&mut self, angle: Angle) -> f64 {
        self.turns_in_units += i64::from(angle.0.wrapping_sub(self.last.0));
        self.last = angle;
        self.turns_in_units as f64 * (TAU / 2f64.powi(32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_counted() {
        let path = (0..1000).map(|k| 20.0 + 0.03 * f64::from(k));
        let mut unwrapper = Unwrapper::near(Angle::from_radians(20.0), 20.0);
        for q in path {
            let error = unwrapper.update(Angle::from_radians((q % TAU) as f32)) - q;
            assert!(error.abs() < 2e-6, "{error:e}");
        }
    }
}
