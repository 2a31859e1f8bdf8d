//! Where an effect can be hidden in an arm.

use rig::effects::{Catalogue, Definition};

use super::kind::ArmKind;
use crate::rng::Rng;

/// An effect of the arm's catalogue and its joint, 0 for the whole arm; each effect is as likely.
pub fn drawn(kind: ArmKind, joints: usize, rng: &mut Rng) -> (&'static Definition, u8) {
    let all: Vec<&'static Definition> = Catalogue::of_arm(joints)
        .iter()
        .filter(|effect| is_possible(kind, joints, effect))
        .collect();
    let definition = *rng.pick(&all);
    let numbers: Vec<u8> = (1..=joints as u8).collect();
    (definition, if definition.whole_robot { 0 } else { *rng.pick(&numbers) })
}

/// Whether the effect is one of its own on such an arm.
fn is_possible(kind: ArmKind, joints: usize, effect: &Definition) -> bool {
    if kind.is_of_servos() {
        return servo::effect_table::is_known(effect.name) || effect.name == "payload";
    }
    // On one joint a force on the tip, or a base that leans, is an offset or another gravity.
    let is_of_joint = effect.whole_robot && effect.touches.drive && joints == 1;
    // A refit opens the model's own peak of friction, finds it, and says so among what it changed.
    if effect.name == "stribeck" {
        return false;
    }
    // Without gravity no posture differs from another.
    let shows_by_gravity = ["encoder_offset", "load_friction"].contains(&effect.name);
    // A scale along the axis has no shaft: a wave per 2 pi metres over half a metre is another scale.
    let shows_by_turning = effect.name == "encoder_eccentricity";
    let is_nothing = (shows_by_gravity || shows_by_turning) && kind == ArmKind::LinearJoint;
    !(is_of_joint || is_nothing)
}
