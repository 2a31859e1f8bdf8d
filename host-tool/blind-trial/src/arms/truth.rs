//! An arm that is not quite its model.

use files::arm_file::ArmFriction;
use files::{ArmFile, ArmJoint};

use super::kind::ArmKind;
use crate::rng::Rng;

/// How far links, rotors and friction are from the model, in parts of them: what an identification
/// leaves.
const PART: f64 = 0.02;
/// How far friction and rotors of servos differ from one to the next.
const SERVO_PART: f64 = 0.1;
/// No further than this many deviations.
const DEVIATIONS: f64 = 2.5;

/// The true arm; torque constants are the model's.
pub fn drawn(kind: ArmKind, nominal: &ArmFile, rng: &mut Rng) -> ArmFile {
    let drive_part = if kind.is_of_servos() { SERVO_PART } else { PART };
    let mut truth = nominal.clone();
    truth.joints.iter_mut().for_each(|joint| vary(joint, drive_part, rng));
    truth
}

fn vary(joint: &mut ArmJoint, drive_part: f64, rng: &mut Rng) {
    let mut about = |part: f64| 1.0 + part * rng.normal_within(DEVIATIONS);
    // All components alike, so that a body stays one that can be.
    let (mass, centre, size) = (about(PART), about(PART), about(PART));
    joint.link.mass_kg = joint.link.mass_kg.map(|m| m * mass);
    joint.link.com_m = joint.link.com_m.map(|com| com.map(|c| c * centre));
    joint.link.inertia_kg_m2 = joint.link.inertia_kg_m2.map(|all| all.map(|i| i * mass * size));
    joint.armature = joint.armature.map(|rotor| rotor * about(drive_part));
    joint.friction = joint.friction.map(|friction| ArmFriction {
        alpha0: friction.alpha0.map(|level| level * about(drive_part)),
        alpha2: friction.alpha2.map(|viscous| viscous * about(drive_part)),
        ..friction
    });
}
