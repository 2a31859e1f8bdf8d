//! What the refit alone moved.

use diagnosis::ParameterChange;
use rayon::prelude::*;

use crate::fit::{Field, errors, squares};
use crate::joint::ServoJoint;
use crate::outcome::Outcome;
use crate::report_intervals::of_fit;

/// The base's parameters that moved, largest share first: the share is what goes of the squares when
/// the parameter alone is taken over into the model as given, of all that the refit takes.
pub fn changes(outcome: &Outcome) -> Vec<ParameterChange> {
    let joints: Vec<usize> = (0..outcome.prepared.bases.len()).collect();
    let found: Vec<Vec<ParameterChange>> =
        joints.par_iter().map(|joint| of_joint(outcome, *joint)).collect();
    let mut found: Vec<ParameterChange> = found.into_iter().flatten().collect();
    found.retain(|change| change.share.abs() > LEAST_SHARE);
    found.sort_by(|a, b| b.share.total_cmp(&a.share));
    found
}

/// A change that takes less is none.
const LEAST_SHARE: f64 = 0.005;

fn of_joint(outcome: &Outcome, joint: usize) -> Vec<ParameterChange> {
    let base = &outcome.prepared.bases[joint];
    let logs = outcome.prepared.held_out();
    let left = |servo: &ServoJoint| -> f64 {
        let of = |log: &&crate::judged::Judged| {
            squares(&errors(servo, log, joint, outcome.settings.search_step_s), log, joint).0
        };
        logs.iter().map(of).sum()
    };
    let (given, found) = (base.given, base.fitted.servo);
    let taken = (left(&given) - left(&found)).max(f64::MIN_POSITIVE);
    let intervals = of_fit(&base.unknowns, &base.fitted);
    let of = |(field, interval): (Field, [f64; 2])| {
        let mut moved = given;
        field.set(&mut moved, field.of(&found));
        ParameterChange {
            parameter: name(outcome, joint, field),
            given: field.of(&given),
            is_given: true,
            found: field.of(&found),
            interval,
            share: ((left(&given) - left(&moved)) / taken).min(1.0),
        }
    };
    intervals.into_iter().map(of).collect()
}

/// A field's name in the model file.
fn name(outcome: &Outcome, joint: usize, field: Field) -> String {
    let names = outcome.arm.joints[joint].friction_names();
    let number = joint + 1;
    match field {
        Field::Coulomb => format!("joint[{number}].friction.{}", names[0]),
        Field::Viscous => format!("joint[{number}].friction.{}", names[3]),
        Field::Rotor => format!("joint[{number}].{}", outcome.arm.joints[joint].armature_name()),
        Field::Gravity => format!("joint[{number}].gravity_scale"),
        _ => format!("joint[{number}].reading.after_goal_s"),
    }
}
