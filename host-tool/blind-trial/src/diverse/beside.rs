//! What is true of a case beside its causes and small effects, and has a name in the catalogue: motor
//! constants that the model has wrong, and friction that falls as the joint warms.

use crate::case::Case;
use crate::cause::{TrueCause, TrueEffect};
use rig::effects::Catalogue;

/// Least part by which a motor constant is off that counts.
const LEAST_OFF: f64 = 0.005;

/// All that is true of a case's robot against its model, beside what was hidden.
pub fn beside(case: &Case) -> Vec<TrueCause> {
    let of_joint = |joint: usize| [wrong_constant(case, joint), warming(case, joint)];
    (0..3).flat_map(of_joint).flatten().collect()
}

/// A motor constant that the model has wrong.
fn wrong_constant(case: &Case, joint: usize) -> Option<TrueCause> {
    let constant = |robot: &model::Robot<f64>| robot.torque_constant_nm_per_v[joint];
    let relative_error = constant(&case.robot) / constant(&case.nominal) - 1.0;
    (relative_error.abs() > LEAST_OFF)
        .then(|| named("torque_constant", joint, vec![relative_error]))
        .flatten()
}

/// Friction that falls with its own work.
fn warming(case: &Case, joint: usize) -> Option<TrueCause> {
    let heat = case.reality.as_ref()?.friction[joint].heat?;
    named("friction_drift", joint, vec![-heat.fall, heat.time_constant_s])
}

fn named(effect: &str, joint: usize, values: Vec<f64>) -> Option<TrueCause> {
    let definition = Catalogue::standard().by_name(effect)?;
    Some(TrueCause::new(TrueEffect::Catalogue(definition), joint as u8 + 1, values))
}
