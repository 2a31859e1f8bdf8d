//! What a joint weighs against its command.

use crate::logs::stretch::Stretch;
use crate::trial::hypothesis::Hypothesis;
use crate::trial::rigid_body::{Path, smallest_inertia};

/// The smallest inertia that a joint (from 0) has in a stretch, in volts as sent [V s^2/rad].
pub fn lightest(stretch: &Stretch, hypothesis: &Hypothesis, joint: usize) -> f64 {
    let plant = &hypothesis.plant;
    let path = Path { motion: &stretch.motion, postures: &stretch.postures, sines: &[] };
    let torque_constant = plant.torque_constant_nm_per_v[joint] * hypothesis.motor_gain(joint);
    smallest_inertia(&plant.body, joint, path) / torque_constant
}
