//! An offset of the converter or the amplifier.

use firmware::compensation::{InputInverse, limits};

use crate::effects::{
    Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search, Size, Touches,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "dac_offset",
    words: "the amplifier adds a constant voltage",
    equation: "u + offset",
    whole_robot: false,
    parameters: &[Parameter::of_board("offset_V", Kind::Offset, limits::DAC_OFFSET_V)],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::From(|typical| vec![vec![0.1 * typical.friction_v]]),
    size: Size::grows(|typical| typical.friction_v),
    draw: |_, random| vec![random.signed_log_uniform(0.03, 0.2)],
    confused_with: &[
        Confusion::effect(
            "asymmetric_friction",
            "while the joint slides one way, both are a constant",
            "reversals, and the viscous part of friction at several speeds",
        )
        .compared(),
        Confusion::effect(
            "cable_spring",
            "-k (q - q0) + c is a spring with another q0",
            "motion over more than a turn, and nothing where a joint has both",
        )
        .compared(),
    ],
    compensation: Compensation::Inverse(|values| {
        Ok(InputInverse::DacOffset { offset_v: values[0] as f32 })
    }),
    experiment: "slow motion both ways (`rrr run slow`)",
    build: |joint, values| {
        Box::new(DacOffset { joint: usize::from(joint) - 1, offset_v: values[0] })
    },
};

/// On an arm of any kind, whose commands may be newtons or amperes.
pub(super) const OF_ARM: Definition =
    Definition { parameters: &[Parameter::new("offset_V", Kind::Offset, -1e4, 1e4)], ..DEFINITION };

#[derive(Clone, Debug)]
struct DacOffset {
    joint: usize,
    offset_v: f64,
}

impl Effect for DacOffset {
    fn change_command(&mut self, _: &JointState, command_v: &mut [f64]) {
        command_v[self.joint] += self.offset_v;
    }
}
