//! A torque constant that is not what the data sheet says.

use firmware::compensation::{InputInverse, limits};
use model::effects::torque_constant_factor;

use crate::effects::{
    Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search, Size, Touches,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "torque_constant",
    words: "the motor gives more or less torque per volt than the model believes",
    equation: "torque = (1 + e) k_t u",
    whole_robot: false,
    parameters: &[Parameter::of_board(
        "relative_error",
        Kind::RelativeChange,
        limits::TORQUE_CONSTANT_ERROR,
    )],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::From(|_| vec![vec![0.05]]),
    size: Size::grows(|_| 0.3),
    draw: |_, random| vec![random.signed_log_uniform(0.05, 0.2)],
    confused_with: &[Confusion::model(
        "a heavier arm",
        "one scale of all gains times one scale of all masses changes nothing",
        "a weighed payload: its mass is known",
    )],
    compensation: Compensation::Inverse(|values| {
        Ok(InputInverse::TorqueConstant { relative_error: values[0] as f32 })
    }),
    experiment: "the same motion with and without a known mass at the tip (`rrr run task`)",
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
    fn change_command(&mut self, _: &JointState, command_v: &mut [f64]) {
        command_v[self.joint] *= torque_constant_factor(self.relative_error);
    }

    fn motor_gain(&self, joint: usize) -> f64 {
        if joint == self.joint { torque_constant_factor(self.relative_error) } else { 1.0 }
    }
}
