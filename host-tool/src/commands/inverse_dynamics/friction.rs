//! Friction of a joint in steady motion, eq. (10), in the unit of its command.

use files::{ArmJoint, FrictionTable};
use model::Friction;

/// The friction of a table of format 1; bristles do not matter in steady motion.
pub fn of_table(table: &FrictionTable) -> Friction<f64> {
    Friction {
        alpha0_v: table.alpha0_v,
        alpha1_v: table.alpha1_v,
        stribeck_velocity_rad_per_s: table.stribeck_velocity_rad_per_s,
        alpha2_v_s_per_rad: table.alpha2_v_s_per_rad,
        sigma0_v_per_rad: 1.0,
        sigma1_v_s_per_rad: 0.0,
    }
}

/// That of a joint of format 2; what its file does not tell is none.
pub fn of_joint(joint: &ArmJoint) -> Option<Friction<f64>> {
    let friction = joint.friction?;
    Some(Friction {
        alpha0_v: friction.alpha0.unwrap_or(0.0),
        alpha1_v: friction.alpha1.filter(|_| friction.stribeck_velocity.is_some()).unwrap_or(0.0),
        stribeck_velocity_rad_per_s: friction.stribeck_velocity.unwrap_or(1.0),
        alpha2_v_s_per_rad: friction.alpha2.unwrap_or(0.0),
        sigma0_v_per_rad: 1.0,
        sigma1_v_s_per_rad: 0.0,
    })
}
