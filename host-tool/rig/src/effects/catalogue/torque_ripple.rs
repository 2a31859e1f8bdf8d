//! A torque constant that varies over the turn.

use firmware::compensation::{InputInverse, limits};
use model::effects::ripple_factor;

use crate::effects::{
    Carrier, Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search,
    Size, Touches, Wave, harmonic, turn_wave,
};
use crate::plant::Gear;

pub(super) const DEFINITION: Definition = Definition {
    name: "torque_ripple",
    words: "the torque constant varies over the turn",
    equation: "u (1 + a sin(n q + phi))",
    whole_robot: false,
    parameters: &[
        Parameter::of_board("relative_amplitude", Kind::Amplitude, limits::TORQUE_RIPPLE),
        Parameter::of_board("harmonic", Kind::Harmonic, limits::HARMONIC),
        Parameter::new("phase_rad", Kind::Phase, -6.3, 6.3),
    ],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::Harmonics(Carrier::Command),
    size: Size::grows(|_| 0.5),
    draw: |_, random| harmonic(random, [0.03, 0.15], 24),
    confused_with: &[Confusion::effect(
        "cogging",
        "where the command follows gravity, ripple is cogging one order up or down",
        "the same angles under another load",
    )
    .compared()],
    compensation: Compensation::Inverse(|values| {
        let wave = turn_wave(values[1], values[2])?;
        Ok(InputInverse::TorqueRipple { relative_amplitude: values[0] as f32, wave })
    }),
    experiment: "motion under load over a whole turn (`rrr run excitation`)",
    build: |joint, values| {
        Box::new(TorqueRipple {
            joint: usize::from(joint) - 1,
            relative_amplitude: values[0],
            wave: Wave::new(values[1], values[2]),
        })
    },
};

#[derive(Clone, Debug)]
struct TorqueRipple {
    joint: usize,
    relative_amplitude: f64,
    wave: Wave,
}

impl Effect for TorqueRipple {
    fn set_gears(&mut self, gears: &[Gear]) {
        self.wave.set_motor(gears[self.joint]);
    }

    fn set_interval(&mut self, interval_s: f64) {
        self.wave.set_interval(interval_s);
    }

    fn change_command(&mut self, state: &JointState, command_v: &mut [f64]) {
        let sine = self.wave.sine(state.q_rad[self.joint], state.qd_rad_per_s[self.joint]);
        command_v[self.joint] *= ripple_factor(self.relative_amplitude, sine);
    }
}
