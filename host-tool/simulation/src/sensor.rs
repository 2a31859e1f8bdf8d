//! What the encoders see.

use std::f64::consts::TAU;

use model::vector::Vector3;

/// Encoder counts of joint angles, the nearest count each.
pub fn counts(q_rad: &Vector3<f64>, counts_per_turn: u32) -> [i64; 3] {
    q_rad.map(|q| (q / TAU * f64::from(counts_per_turn)).round() as i64)
}
