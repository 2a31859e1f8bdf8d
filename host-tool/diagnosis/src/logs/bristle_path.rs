//! How far a joint goes until its friction has forgotten how its bristles were bent.

use model::Friction;

/// A path of so many times the largest bend of a joint's bristles [rad].
pub fn path_rad(friction: &Friction<f64>, bends: f64) -> f64 {
    let level_v = friction.alpha0_v + friction.alpha1_v.max(0.0);
    bends * level_v / friction.sigma0_v_per_rad
}
