//! True angles behind what an encoder out of true reads.

use std::borrow::Cow;

use model::chain::MAX_JOINTS;

use crate::logs::kinematics::Kinematics;
use rig::effects::Effect;

/// The motion with the effects' changes of the reading undone.
pub fn corrected<'a>(motion: &'a Kinematics, effects: &[Box<dyn Effect>]) -> Cow<'a, Kinematics> {
    let mut corrected = Cow::Borrowed(motion);
    let joints = motion.joints();
    for joint in 0..joints {
        let read = |q: f64| {
            let mut angles = [q; MAX_JOINTS];
            let angles = &mut angles[..joints];
            effects.iter().for_each(|effect| effect.change_reading(angles));
            angles[joint]
        };
        if [0.3, 1.7, 3.1, 4.4].iter().any(|&q| read(q) != q) {
            undo(corrected.to_mut(), joint, read);
        }
    }
    corrected
}

/// Step of the differences that give the reading's slope and curvature [rad].
const STEP_RAD: f64 = 1e-3;

fn undo(motion: &mut Kinematics, joint: usize, read: impl Fn(f64) -> f64) {
    for k in 0..motion.q_rad[joint].len() {
        motion.raw_rad[joint][k] -= read(motion.raw_rad[joint][k]) - motion.raw_rad[joint][k];
        let reading = motion.q_rad[joint][k];
        let mut q = reading;
        for _ in 0..3 {
            q -= read(q) - reading;
        }
        let (before, here, after) = (read(q - STEP_RAD), read(q), read(q + STEP_RAD));
        let slope = (after - before) / (2.0 * STEP_RAD);
        let curvature = (after + before - 2.0 * here) / (STEP_RAD * STEP_RAD);
        let velocity = motion.qd_rad_per_s[joint][k] / slope;
        let acceleration = motion.qdd_rad_per_s2[joint][k] - curvature * velocity * velocity;
        motion.q_rad[joint][k] = q;
        motion.qd_rad_per_s[joint][k] = velocity;
        motion.qdd_rad_per_s2[joint][k] = acceleration / slope;
    }
}
