//! A diagnosis in a few sentences.

mod causes;
mod figures;
mod no_gap;
mod refit;
#[cfg(test)]
mod tests;
mod unexplained;

use causes::named;
pub use figures::joint_numbers;
use figures::{largest_excess, size};
use no_gap::no_gap;
use unexplained::unexplained;

use super::words::percent;
pub use super::words::{effect_words, joint_words};
use crate::result::{Diagnosis, ModelFaultFound, Verdict};

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
