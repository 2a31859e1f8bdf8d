//! Friction of an arm's joint, with values where the file has none.

use files::ArmJoint;
use model::Friction;
use model::friction_parameters::COUNT;

/// Which of a joint's friction parameters the file tells. Where it is silent of a rise towards standstill or of viscous
/// friction it says that there is none.
pub fn told(joint: &ArmJoint) -> [bool; COUNT] {
    let given = joint.friction.unwrap_or_default();
    let [alpha0, stribeck_velocity, sigma0, sigma1] =
        [given.alpha0, given.stribeck_velocity, given.sigma0, given.sigma1].map(|v| v.is_some());
    [alpha0, true, stribeck_velocity, true, sigma0, sigma1]
}

/// What the logs show of a joint, for values that the file does not give.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    /// Root mean square of its command.
    pub command: f64,
    /// Root mean square of its velocity [rad/s; m/s].
    pub speed: f64,
}

/// Bristles that no file gives bend by this part of a second of motion.
const BENT_S: f64 = 1e-3;
/// Damping of bristles that no file gives is within this time of their stiffness [s]: wide, it stands
/// for inertia and lags, and a search ends where it does.
const DAMPED_S: f64 = 1e-4;
/// Unknown Stribeck velocity, in parts of the joint's own.
const SLOW: f64 = 0.01;
/// Unknown friction in parts of the command.
const OF_COMMAND: f64 = 0.1;
/// No friction is less than this part of the command.
const LEAST: f64 = 1e-5;

/// Friction, and the standard deviations that the file gives for it or that follow from its saying
/// nothing.
pub fn friction(joint: &ArmJoint, shown: Shown) -> (Friction<f64>, [Option<f64>; COUNT]) {
    let given = joint.friction.unwrap_or_default();
    let (command, speed) = (shown.command.max(1e-9), shown.speed.max(1e-9));
    let unknown = OF_COMMAND * command;
    let alpha0_v = given.alpha0.unwrap_or(unknown).max(LEAST * command);
    let alpha1_v = given.alpha1.unwrap_or(0.0);
    let level_v = alpha0_v.max(alpha0_v + alpha1_v);
    let friction = Friction {
        alpha0_v,
        alpha1_v,
        stribeck_velocity_rad_per_s: given.stribeck_velocity.unwrap_or(SLOW * speed),
        alpha2_v_s_per_rad: given.alpha2.unwrap_or(0.0),
        sigma0_v_per_rad: given.sigma0.unwrap_or(level_v / (BENT_S * speed)),
        sigma1_v_s_per_rad: given.sigma1.unwrap_or(0.0),
    };
    let names = joint.friction_names();
    let error = |k: usize| joint.standard_error(&names[k]).and_then(|e| e.first().copied());
    let mut deviations: [Option<f64>; COUNT] = std::array::from_fn(error);
    deviations[0] = deviations[0].or(given.alpha0.is_none().then_some(unknown));
    deviations[3] = deviations[3].or(given.alpha2.is_none().then_some(unknown / speed));
    let undamped = given.sigma1.is_none().then_some(DAMPED_S * friction.sigma0_v_per_rad);
    deviations[5] = deviations[5].or(undamped);
    (friction, deviations)
}
