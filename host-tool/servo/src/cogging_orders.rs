//! Which orders of cogging are worth a fit.

use nalgebra::{Matrix2, Vector2};

use crate::base::Frame;
use crate::fit::errors;
use crate::joint::ServoJoint;

/// The highest order that is looked for: a wave of sixteen in a turn is some twenty degrees long.
pub const HIGHEST: usize = 16;

/// The two orders per turn that take most of what a joint leaves, were it a voltage on a servo at
/// rest.
pub fn cogging_orders(frame: &Frame, joint: usize, servo: &ServoJoint) -> Vec<f64> {
    let step = frame.settings.search_step_s;
    let points: Vec<(f64, f64)> = frame
        .logs
        .iter()
        .flat_map(|log| {
            let left = errors(servo, log, joint, step);
            let track = &log.record.joints[joint];
            let rows = (0..left.len()).filter(|row| log.counts[joint][*row]).step_by(5);
            rows.map(|row| (track.position[row], left[row])).collect::<Vec<_>>()
        })
        .collect();
    let mut orders: Vec<(f64, f64)> =
        (1..=HIGHEST).map(|n| n as f64).map(|n| (taken(&points, n), n)).collect();
    orders.sort_by(|a, b| b.0.total_cmp(&a.0));
    orders.into_iter().take(2).map(|(_, order)| order).collect()
}

/// Squares that a sine and a cosine of an order take.
fn taken(points: &[(f64, f64)], order: f64) -> f64 {
    let (mut matrix, mut right) = (Matrix2::zeros(), Vector2::zeros());
    for (position, error) in points {
        let (sine, cosine) = (order * position).sin_cos();
        let column = Vector2::new(sine, cosine);
        matrix += column * column.transpose();
        right += column * *error;
    }
    matrix.lu().solve(&right).map_or(0.0, |found| found.dot(&right))
}
