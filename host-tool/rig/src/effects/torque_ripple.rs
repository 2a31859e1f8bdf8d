//! A torque constant that varies over the turn.

use model::effects::{AngularHarmonic, ripple_factor};
use model::vector::Vector3;

use super::{Carrier, Definition, Effect, JointState, Parameter, Search, Size, Touches};

pub(super) const DEFINITION: Definition = Definition {
    name: "torque_ripple",
    words: "the torque constant varies over the turn",
    equation: "u (1 + a sin(n q + phi))",
    whole_robot: false,
    parameters: &[
        Parameter::new("relative_amplitude", 0.0, 0.9),
        Parameter::new("harmonic", 1.0, 1000.0),
        Parameter::new("phase_rad", -6.3, 6.3),
    ],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::Harmonics(Carrier::Command),
    size: Size::grows(|_| 0.5),
    experiment: "`rrr run excitation` over a whole turn under load",
    build: |joint, values| {
        Box::new(TorqueRipple {
            joint: usize::from(joint) - 1,
            relative_amplitude: values[0],
            wave: AngularHarmonic { order: values[1], phase_rad: values[2] },
        })
    },
};

#[derive(Clone, Debug)]
struct TorqueRipple {
    joint: usize,
    relative_amplitude: f64,
    wave: AngularHarmonic<f64>,
}

impl Effect for TorqueRipple {
    fn change_command(&mut self, state: &JointState, command_v: &mut Vector3<f64>) {
        let sine = self.wave.sine(state.q_rad[self.joint]);
        command_v[self.joint] *= ripple_factor(self.relative_amplitude, sine);
    }
}
