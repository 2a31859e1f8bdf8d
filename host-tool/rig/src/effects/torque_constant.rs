//! A torque constant that is not what the data sheet says.

use model::effects::torque_constant_factor;
use model::vector::Vector3;

use super::{Definition, Effect, JointState, Parameter, Search, Size, Touches};

pub(super) const DEFINITION: Definition = Definition {
    name: "torque_constant",
    words: "the motor gives more or less torque per volt than the model believes",
    equation: "torque = (1 + e) k_t u",
    whole_robot: false,
    parameters: &[Parameter::new("relative_error", -0.5, 0.5)],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::From(|_| vec![vec![0.05]]),
    size: Size::grows(|_| 0.3),
    experiment: "move a known payload: `rrr run task` with and without a mass at the tip",
    build: |joint, values| {
        Box::new(TorqueConstant { joint: usize::from(joint) - 1, relative_error: values[0] })
    },
};

#[derive(Clone, Debug)]
struct TorqueConstant {
    joint: usize,
    relative_error: f64,
}

impl Effect for TorqueConstant {
    fn change_command(&mut self, _: &JointState, command_v: &mut Vector3<f64>) {
        command_v[self.joint] *= torque_constant_factor(self.relative_error);
    }
}
