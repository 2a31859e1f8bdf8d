//! An amplifier whose halves differ.

use super::definition::Definition;
use rig::effects::{Effect, JointState};

pub(super) const DEFINITION: Definition = Definition {
    name: "uneven_gain",
    words: "positive commands are amplified more than negative ones: (1 +- g) u",
    resembles: &["asymmetric_friction", "torque_constant", "dac_offset"],
    equivalent: &[],
    grows: true,
    parameters: &["relative_difference"],
    draw: |_, random| vec![random.signed_log_uniform(0.03, 0.15)],
    build: |joint, values| Box::new(UnevenGain { joint, relative_difference: values[0] }),
};

#[derive(Clone, Debug)]
struct UnevenGain {
    joint: usize,
    relative_difference: f64,
}

impl Effect for UnevenGain {
    fn change_command(&mut self, _: &JointState, command_v: &mut [f64]) {
        command_v[self.joint] += self.relative_difference * command_v[self.joint].abs();
    }
}
