//! The model with what was refitted and what is named.

use files::ArmFile;

use crate::effect_table::table;
use crate::fit::Field;
use crate::joint::ServoJoint;
use crate::outcome::Outcome;
use crate::whole_table;

/// The arm's file with rotors and friction as refitted, and a table for each effect.
pub fn model_file(outcome: &Outcome) -> ArmFile {
    let servos: Vec<ServoJoint> = outcome.models.iter().map(|model| model.fitted.servo).collect();
    let mut file = refitted(&outcome.arm, &servos);
    for (joint, model) in outcome.models.iter().enumerate() {
        for effect in &model.effects {
            file.effects.push(table(effect.effect, joint + 1, &servos[joint]));
        }
    }
    let whole = outcome.whole.iter().filter(|cause| cause.is_named);
    let tables = whole.map(|cause| whole_table::table(cause.fit.effect, &cause.fit.values));
    file.effects.extend(tables);
    file
}

/// The arm's file with the numbers of a refit; what formats have no place for as tables.
pub fn refitted(arm: &ArmFile, servos: &[ServoJoint]) -> ArmFile {
    let mut file = arm.clone();
    for (k, (joint, servo)) in file.joints.iter_mut().zip(servos).enumerate() {
        joint.armature = Some(servo.rotor);
        let mut friction = joint.friction.unwrap_or_default();
        friction.alpha0 = Some(servo.coulomb);
        friction.alpha2 = Some(servo.viscous);
        joint.friction = Some(friction);
        for (effect, field) in [("gravity_scale", Field::Gravity), ("reading", Field::ReadAfter)] {
            file.effects
                .retain(|table| table.effect != effect || usize::from(table.joint) != k + 1);
            let delayed = effect == "reading" && servo.read_after_s < 0.0;
            if field.of(servo) != field.of(&ServoJoint::ideal()) && !delayed {
                file.effects.push(table(effect, k + 1, servo));
            }
        }
    }
    file
}
