//! An amplifier that swallows small commands.

use firmware::compensation::{InputInverse, limits};
use model::effects::dead_zone;

use crate::effects::{
    Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search, Size, Touches,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "dead_zone",
    words: "the amplifier swallows the first volts of every command",
    equation: "sgn(u) max(|u| - d, 0)",
    whole_robot: false,
    parameters: &[Parameter::of_board("half_width_V", Kind::HalfWidth, limits::DEAD_ZONE_V)],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::From(|typical| [0.1, 0.4].map(|part| vec![part * typical.friction_v]).to_vec()),
    size: Size::grows(|typical| typical.friction_v),
    draw: |_, random| vec![random.log_uniform(0.05, 0.3)],
    confused_with: &[
        Confusion::effect(
            "torque_constant",
            "both take a part of every command",
            "commands from small to large",
        )
        .compared(),
        Confusion::model(
            "Coulomb friction",
            "they look alike wherever command and velocity have the same sign",
            "gravity load: joints 2 and 3, `slow`",
        ),
    ],
    compensation: Compensation::Inverse(|values| {
        Ok(InputInverse::DeadZone { half_width_v: values[0] as f32 })
    }),
    experiment: "motion in which commands cross zero while the joint slides (`rrr run excitation`)",
    build: |joint, values| {
        Box::new(DeadZone { joint: usize::from(joint) - 1, half_width_v: values[0] })
    },
};

/// On an arm of any kind, whose commands may be newtons or amperes.
pub(super) const OF_ARM: Definition = Definition {
    parameters: &[Parameter::new("half_width_V", Kind::HalfWidth, 0.0, 1e4)],
    ..DEFINITION
};

#[derive(Clone, Debug)]
struct DeadZone {
    joint: usize,
    half_width_v: f64,
}

impl Effect for DeadZone {
    fn change_command(&mut self, _: &JointState, command_v: &mut [f64]) {
        command_v[self.joint] = dead_zone(command_v[self.joint], self.half_width_v);
    }
}
