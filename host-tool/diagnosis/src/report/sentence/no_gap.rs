//! That there is no gap, in words.

use super::figures::{joint_numbers, largest_excess, size};
use super::refit::refitted;
use crate::result::Diagnosis;

/// That noise alone is left, and what the refit moved.
pub(super) fn no_gap(diagnosis: &Diagnosis) -> String {
    let parts: Vec<String> =
        [Some(no_gap_left(diagnosis)), refitted(diagnosis)].into_iter().flatten().collect();
    parts.join(" ")
}

fn no_gap_left(diagnosis: &Diagnosis) -> String {
    let gap = &diagnosis.report.gap;
    let joints = joint_numbers(diagnosis);
    let largest = largest_excess(&gap.refitted_v, &gap.noise_floor_v);
    let (Some((index, _)), true) = (largest, gap.as_given_v.len() == gap.refitted_v.len()) else {
        return "No gap above the noise.".into();
    };
    let joint = joints.get(index).copied().unwrap_or(0);
    let (given_v, left_v) = (gap.as_given_v[index], gap.refitted_v[index]);
    let of_joint = |value: f64| size(diagnosis, joint, value);
    let floor = of_joint(gap.noise_floor_v[index]);
    if given_v > diagnosis.criteria.verdict.worth_refitting * left_v {
        let (given, left) = (of_joint(given_v), of_joint(left_v));
        return format!(
            "No gap above the noise once the model is refitted: that takes joint {joint} from \
             {given} to {left}, where noise alone leaves {floor}."
        );
    }
    let left = of_joint(left_v);
    format!("No gap above the noise: {left} are left on joint {joint}, noise alone leaves {floor}.")
}
