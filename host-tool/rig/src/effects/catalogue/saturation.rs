//! An amplifier that gives less than the model's limit.

use crate::effects::{
    Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search, Size, Touches,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "saturation",
    words: "the amplifier gives no more than a limit that the model does not know",
    equation: "u cut at +-L",
    whole_robot: false,
    parameters: &[Parameter::new("limit_V", Kind::Limit, 0.01, 100.0)],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::From(|typical| {
        // A controller that fights the limit asks for many times what it gets.
        let parts = [0.93, 0.8, 0.65, 0.5, 0.38, 0.28, 0.2, 0.14, 0.1];
        parts.map(|part| vec![part * typical.command_v]).to_vec()
    }),
    size: Size::shrinks(|typical| 0.3 * typical.command_v),
    draw: |context, random| vec![random.uniform(0.4, 0.95) * context.peak_command_v[context.joint]],
    confused_with: &[Confusion::effect(
        "torque_constant",
        "a limit that only one log reaches looks like a smaller gain",
        "motion so fast that commands of two logs reach the limit",
    )],
    compensation: Compensation::None("an amplifier gives no more than it can"),
    experiment: "motion so fast that commands reach the limit",
    build: |joint, values| {
        Box::new(Saturation { joint: usize::from(joint) - 1, limit_v: values[0] })
    },
};

/// On an arm of any kind, whose commands may be newtons or amperes.
pub(super) const OF_ARM: Definition =
    Definition { parameters: &[Parameter::new("limit_V", Kind::Limit, 1e-4, 1e5)], ..DEFINITION };

#[derive(Clone, Debug)]
struct Saturation {
    joint: usize,
    limit_v: f64,
}

impl Effect for Saturation {
    fn change_command(&mut self, _: &JointState, command_v: &mut [f64]) {
        command_v[self.joint] = command_v[self.joint].clamp(-self.limit_v, self.limit_v);
    }
}
