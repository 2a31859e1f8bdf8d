//! An amplifier that swallows small commands.

use model::effects::dead_zone;
use model::vector::Vector3;

use super::{Definition, Effect, JointState, Parameter, Search, Size, Touches};

pub(super) const DEFINITION: Definition = Definition {
    name: "dead_zone",
    words: "the amplifier swallows the first volts of every command",
    equation: "sgn(u) max(|u| - d, 0)",
    whole_robot: false,
    parameters: &[Parameter::new("half_width_V", 0.0, 5.0)],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::From(|typical| [0.1, 0.4].map(|part| vec![part * typical.friction_v]).to_vec()),
    size: Size::grows(|typical| typical.friction_v),
    experiment: "`rrr run excitation`, where commands cross zero while the joint slides",
    build: |joint, values| {
        Box::new(DeadZone { joint: usize::from(joint) - 1, half_width_v: values[0] })
    },
};

#[derive(Clone, Debug)]
struct DeadZone {
    joint: usize,
    half_width_v: f64,
}

impl Effect for DeadZone {
    fn change_command(&mut self, _: &JointState, command_v: &mut Vector3<f64>) {
        command_v[self.joint] = dead_zone(command_v[self.joint], self.half_width_v);
    }
}
