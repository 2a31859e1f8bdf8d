//! A diagnosis in a few sentences.

mod causes;
mod no_gap;
mod refit;
#[cfg(test)]
mod tests;
mod unexplained;

use causes::named;
use no_gap::no_gap;
use unexplained::unexplained;

use super::words::percent;
pub use super::words::{effect_words, joint_words};
use crate::quantity::volts;
use crate::result::{Diagnosis, ModelFaultFound, Verdict};

/// Most alternatives and parameters that are said.
const MOST_SAID: usize = 2;
/// Share of the gap from which an effect that is not named is said.
const LEAST_SAID_SHARE: f64 = 0.01;

/// What a person must know and can act on.
pub fn sentence(diagnosis: &Diagnosis) -> String {
    if let Some(fault) = &diagnosis.report.model_fault {
        return at_fault(diagnosis, fault);
    }
    match diagnosis.report.verdict {
        Verdict::Effect | Verdict::Partial => named(diagnosis),
        Verdict::None => no_gap(diagnosis),
        Verdict::Unknown => unexplained(diagnosis),
    }
}

/// What is wrong with the model itself.
fn at_fault(diagnosis: &Diagnosis, fault: &ModelFaultFound) -> String {
    let (gap, joints) = (&diagnosis.report.gap, joint_numbers(diagnosis));
    let largest = largest_excess(&gap.refitted_v, &gap.noise_floor_v);
    let of_joint = largest.and_then(|(index, excess_v)| Some((joints.get(index)?, excess_v)));
    let size = of_joint.map_or_else(String::new, |(joint, excess_v)| {
        format!(" of {} on joint {joint}", size(diagnosis, *joint, excess_v))
    });
    format!(
        "The model is not that of this robot: {}. That explains {} % of the gap{size}, and no \
         cause is named until it is put right.",
        fault.what,
        percent(fault.explained)
    )
}

/// The rig's joints, 1 to 3, in the order in which the gap is given.
pub fn joint_numbers(diagnosis: &Diagnosis) -> Vec<u8> {
    match diagnosis.logs.first() {
        Some(log) => log.joints.iter().map(|joint| joint.joint).collect(),
        None => (1..=diagnosis.report.gap.refitted_v.len() as u8).collect(),
    }
}

/// A residual in the unit of its joint.
fn size(diagnosis: &Diagnosis, joint: u8, value: f64) -> String {
    diagnosis.units_of(joint).in_words(&volts(value))
}

/// Where the square lies most above the floor's, and the root of that excess.
fn largest_excess(left_v: &[f64], floor_v: &[f64]) -> Option<(usize, f64)> {
    let squares = left_v.iter().zip(floor_v).map(|(left, floor)| left * left - floor * floor);
    let largest = squares.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((largest.0, largest.1.max(0.0).sqrt()))
}
