//! An encoder whose zero is not where the model has it.

use crate::effects::{
    Compensation, Confusion, Definition, Effect, Kind, Parameter, Search, Size, Touches,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "encoder_offset",
    words: "the home position is another one than the model's",
    equation: "reads q - offset",
    whole_robot: false,
    parameters: &[Parameter::new("offset_rad", Kind::Offset, -1.6, 1.6)],
    couples_joints: true,
    touches: Touches::READING,
    search: Search::From(|_| vec![vec![0.02]]),
    size: Size::grows(|_| 0.2),
    draw: |_, random| vec![random.signed_log_uniform(0.01, 0.1)],
    confused_with: &[
        Confusion::model(
            "gravity's moments",
            "on a joint that bears nothing but its own link both turn the sine of gravity; the prior \
             holds the moments",
            "joints beyond it in several postures, or a lighter arm's weighed links",
        ),
        Confusion::effect(
            "base_tilt",
            "a lean of the base turns the arm about its first horizontal axis, as another zero of that joint does",
            "motion of joint 1 over a whole turn",
        )
        .compared(),
        Confusion::effect(
            "dac_offset",
            "near one posture another home position is a constant torque",
            "motion over a wide range",
        )
        .compared(),
    ],
    compensation: Compensation::None("home the joint anew: the board takes its encoders for true"),
    experiment: "slow motion over a wide range",
    build: |joint, values| {
        Box::new(EncoderOffset { joint: usize::from(joint) - 1, offset_rad: values[0] })
    },
};

#[derive(Clone, Debug)]
struct EncoderOffset {
    joint: usize,
    offset_rad: f64,
}

impl Effect for EncoderOffset {
    fn change_reading(&self, q_rad: &mut [f64]) {
        q_rad[self.joint] -= self.offset_rad;
    }
}
