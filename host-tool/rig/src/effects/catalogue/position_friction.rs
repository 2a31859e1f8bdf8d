//! Friction that varies over the turn.

use firmware::compensation::{Feedforward, limits};
use model::effects::scale_position_friction;
use model::friction::FrictionScale;

use crate::effects::{
    Carrier, Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search,
    Size, Touches, Wave, harmonic, turn_wave,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "position_friction",
    words: "the friction level varies over the turn",
    equation: "gamma (1 + a sin(n q + phi))",
    whole_robot: false,
    parameters: &[
        Parameter::of_board("relative_amplitude", Kind::Amplitude, limits::POSITION_FRICTION),
        Parameter::of_board("harmonic", Kind::Harmonic, limits::HARMONIC),
        Parameter::new("phase_rad", Kind::Phase, -6.3, 6.3),
    ],
    couples_joints: false,
    touches: Touches::FRICTION,
    search: Search::Harmonics(Carrier::Friction),
    size: Size::grows(|_| 0.8),
    draw: |_, random| harmonic(random, [0.15, 0.5], 12),
    confused_with: &[Confusion::effect(
        "load_friction",
        "on joint 2 the load is a function of the angle",
        "another posture, or a payload",
    )
    .compared()
    .never_paired()],
    compensation: Compensation::Feedforward(|values| {
        let wave = turn_wave(values[1], values[2])?;
        Ok(Feedforward::PositionFriction { relative_amplitude: values[0] as f32, wave })
    }),
    experiment: "slow motion both ways over a whole turn",
    build: |joint, values| {
        Box::new(PositionFriction {
            joint: usize::from(joint) - 1,
            relative_amplitude: values[0],
            wave: Wave::new(values[1], values[2]),
        })
    },
};

#[derive(Clone, Debug)]
struct PositionFriction {
    joint: usize,
    relative_amplitude: f64,
    wave: Wave,
}

impl Effect for PositionFriction {
    fn set_interval(&mut self, interval_s: f64) {
        self.wave.set_interval(interval_s);
    }

    fn change_friction(&self, state: &JointState, scale: &mut [FrictionScale<f64>]) {
        let sine = self.wave.sine(state.q_rad[self.joint], state.qd_rad_per_s[self.joint]);
        scale_position_friction(&mut scale[self.joint], self.relative_amplitude, sine);
    }
}
