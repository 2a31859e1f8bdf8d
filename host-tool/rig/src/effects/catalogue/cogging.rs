//! Torque of the magnets on the slots.

use firmware::compensation::{Feedforward, limits};
use model::effects::cogging_v;

use crate::effects::{
    Carrier, Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search,
    Size, Touches, Wave, harmonic, turn_wave,
};
use crate::plant::Gear;

pub(super) const DEFINITION: Definition = Definition {
    name: "cogging",
    words: "the magnets pull towards the slots, whatever the command",
    equation: "u + A sin(n q + phi)",
    whole_robot: false,
    parameters: &[
        Parameter::of_board("amplitude_V", Kind::Amplitude, limits::COGGING_V),
        Parameter::of_board("harmonic", Kind::Harmonic, limits::HARMONIC),
        Parameter::new("phase_rad", Kind::Phase, -6.3, 6.3),
    ],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::Harmonics(Carrier::Unity),
    size: Size::grows(|typical| typical.friction_v),
    draw: |_, random| harmonic(random, [0.03, 0.2], 24),
    confused_with: &[Confusion::model(
        "gravity",
        "once per turn, on joints 2 and 3, both are a sine of the angle; the prior holds gravity",
        "a payload, which changes gravity alone",
    )],
    compensation: Compensation::Feedforward(|values| {
        let wave = turn_wave(values[1], values[2])?;
        Ok(Feedforward::Cogging { amplitude_v: values[0] as f32, wave })
    }),
    experiment: "slow motion both ways over a whole turn",
    build: |joint, values| {
        Box::new(Cogging {
            joint: usize::from(joint) - 1,
            amplitude_v: values[0],
            wave: Wave::new(values[1], values[2]),
        })
    },
};

/// On an arm of any kind, whose commands may be newtons or amperes.
pub(super) const OF_ARM: Definition = Definition {
    parameters: &[
        Parameter::new("amplitude_V", Kind::Amplitude, 0.0, 1e4),
        Parameter::of_board("harmonic", Kind::Harmonic, limits::HARMONIC),
        Parameter::new("phase_rad", Kind::Phase, -6.3, 6.3),
    ],
    ..DEFINITION
};

#[derive(Clone, Debug)]
struct Cogging {
    joint: usize,
    amplitude_v: f64,
    wave: Wave,
}

impl Effect for Cogging {
    fn set_gears(&mut self, gears: &[Gear]) {
        self.wave.set_motor(gears[self.joint]);
    }

    fn set_interval(&mut self, interval_s: f64) {
        self.wave.set_interval(interval_s);
    }

    fn add_voltage(&self, state: &JointState, voltage_v: &mut [f64]) {
        let sine = self.wave.sine(state.q_rad[self.joint], state.qd_rad_per_s[self.joint]);
        voltage_v[self.joint] += cogging_v(self.amplitude_v, sine);
    }
}
