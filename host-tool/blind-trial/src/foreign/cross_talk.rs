//! Wires that lie side by side.

use super::definition::Definition;
use rig::effects::{Effect, JointState};

pub(super) const DEFINITION: Definition = Definition {
    name: "cross_talk",
    words: "a part of another joint's command comes through: u + c u of that joint",
    resembles: &["torque_constant", "torque_ripple", "cable_spring"],
    equivalent: &[],
    grows: true,
    parameters: &["coefficient", "from_joint"],
    draw: |joint, random| {
        let other = (joint + 1 + usize::from(random.unit() < 0.5)) % 3;
        vec![random.signed_log_uniform(0.02, 0.15), other as f64 + 1.0]
    },
    build: |joint, values| {
        let from = (values[1] as usize).clamp(1, 3) - 1;
        Box::new(CrossTalk { joint, coefficient: values[0], from })
    },
};

#[derive(Clone, Debug)]
struct CrossTalk {
    joint: usize,
    coefficient: f64,
    from: usize,
}

impl Effect for CrossTalk {
    fn change_command(&mut self, _: &JointState, command_v: &mut [f64]) {
        command_v[self.joint] += self.coefficient * command_v[self.from];
    }
}
