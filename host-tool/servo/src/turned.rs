//! An encoder's offset as what it is to the other joints: all beyond the joint is turned.
//!
//! Searched for joint by joint, an offset shows by the joint's own gravity, and again by that of every
//! joint whose load it turns. So each that was found is put into the arm, and the one that leaves least of
//! all joints stays.

use crate::base::{Base, Frame, refit};
use crate::joint::ServoJoint;
use crate::joint_effects::JointEffects;
use crate::judged::Judged;
use crate::prepared::Prepared;
use crate::settings::Settings;

/// Turns the arm by the best of the encoder offsets that are named, where the arm then leaves less than as it
/// is; whether there is one.
pub fn take_up(prepared: &mut Prepared, joints: &JointEffects, settings: &Settings) -> bool {
    let is_offset = |effect: &str| effect == "encoder_offset";
    let named = joints.causes.iter().filter(|cause| cause.is_named && is_offset(cause.effect));
    let tried = named.map(|cause| turned(prepared, cause.joint, &cause.servo, settings));
    let unturned: f64 = prepared.bases.iter().map(|base| left(base, base)).sum();
    let best = tried.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(left, _)| *left < unturned);
    let Some((_, best)) = best else { return false };
    *prepared = best;
    true
}

/// Whether an encoder's offset is among the causes that are named.
pub fn is_named(joints: &JointEffects) -> bool {
    joints.causes.iter().any(|cause| cause.is_named && cause.effect == "encoder_offset")
}

/// The arm with one encoder's offset, and what that leaves of all joints in squares of one row.
fn turned(
    prepared: &Prepared,
    joint: usize,
    servo: &ServoJoint,
    settings: &Settings,
) -> (f64, Prepared) {
    let mut found = prepared.clone();
    found.turn(joint, servo.encoder_offset);
    let mut starts: Vec<ServoJoint> = prepared.bases.iter().map(|base| base.fitted.servo).collect();
    let bases = refitted(&found, &starts, settings);
    starts[joint] = *servo;
    let with = refitted(&found, &starts, settings);
    found.bases = bases;
    (with.iter().zip(&prepared.bases).map(|(with, base)| left(with, base)).sum(), found)
}

fn refitted(prepared: &Prepared, starts: &[ServoJoint], settings: &Settings) -> Vec<Base> {
    let train: Vec<&Judged> = prepared.train();
    let frame = Frame { logs: &train, period_s: prepared.period_s, settings };
    refit(&frame, &prepared.given, starts, false)
}

/// What is left of a joint, in squares of one row as another fit left them.
fn left(with: &Base, before: &Base) -> f64 {
    let robust = with.fitted.normals.iter().map(|log| log.robust);
    robust.sum::<f64>() / before.fitted.square_of_one
}
