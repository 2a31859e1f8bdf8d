//! An offset of the converter or the amplifier.

use model::vector::Vector3;

use super::{Definition, Effect, JointState, Parameter, Search, Size, Touches};

pub(super) const DEFINITION: Definition = Definition {
    name: "dac_offset",
    words: "the amplifier adds a constant voltage",
    equation: "u + offset",
    whole_robot: false,
    parameters: &[Parameter::new("offset_V", -5.0, 5.0)],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::From(|typical| vec![vec![0.1 * typical.friction_v]]),
    size: Size::grows(|typical| typical.friction_v),
    experiment: "`rrr run slow`, both ways",
    build: |joint, values| {
        Box::new(DacOffset { joint: usize::from(joint) - 1, offset_v: values[0] })
    },
};

#[derive(Clone, Debug)]
struct DacOffset {
    joint: usize,
    offset_v: f64,
}

impl Effect for DacOffset {
    fn change_command(&mut self, _: &JointState, command_v: &mut Vector3<f64>) {
        command_v[self.joint] += self.offset_v;
    }
}
