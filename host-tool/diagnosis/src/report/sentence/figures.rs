//! What the sentences have in common: figures of the gap, and how much of a list is said.

use crate::quantity::volts;
use crate::result::Diagnosis;

/// Most alternatives and parameters that are said.
pub(super) const MOST_SAID: usize = 2;
/// Share of the gap from which an effect that is not named is said.
pub(super) const LEAST_SAID_SHARE: f64 = 0.01;

/// The rig's joints, 1 to 3, in the order in which the gap is given.
pub fn joint_numbers(diagnosis: &Diagnosis) -> Vec<u8> {
    match diagnosis.logs.first() {
        Some(log) => log.joints.iter().map(|joint| joint.joint).collect(),
        None => (1..=diagnosis.report.gap.refitted_v.len() as u8).collect(),
    }
}

/// A residual in the unit of its joint.
pub(super) fn size(diagnosis: &Diagnosis, joint: u8, value: f64) -> String {
    diagnosis.units_of(joint).in_words(&volts(value))
}

/// Where the square lies most above the floor's, and the root of that excess.
pub(super) fn largest_excess(left_v: &[f64], floor_v: &[f64]) -> Option<(usize, f64)> {
    let squares = left_v.iter().zip(floor_v).map(|(left, floor)| left * left - floor * floor);
    let largest = squares.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((largest.0, largest.1.max(0.0).sqrt()))
}
