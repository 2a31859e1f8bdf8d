//! Torque of the magnets on the slots.

use model::effects::{AngularHarmonic, cogging_v};
use model::vector::Vector3;

use super::{Carrier, Definition, Effect, JointState, Parameter, Search, Size, Touches};

pub(super) const DEFINITION: Definition = Definition {
    name: "cogging",
    words: "the magnets pull towards the slots, whatever the command",
    equation: "u + A sin(n q + phi)",
    whole_robot: false,
    parameters: &[
        Parameter::new("amplitude_V", 0.0, 5.0),
        Parameter::new("harmonic", 1.0, 1000.0),
        Parameter::new("phase_rad", -6.3, 6.3),
    ],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::Harmonics(Carrier::Unity),
    size: Size::grows(|typical| typical.friction_v),
    experiment: "`rrr run slow` over a whole turn",
    build: |joint, values| {
        Box::new(Cogging {
            joint: usize::from(joint) - 1,
            amplitude_v: values[0],
            wave: AngularHarmonic { order: values[1], phase_rad: values[2] },
        })
    },
};

#[derive(Clone, Debug)]
struct Cogging {
    joint: usize,
    amplitude_v: f64,
    wave: AngularHarmonic<f64>,
}

impl Effect for Cogging {
    fn add_voltage(&self, state: &JointState, voltage_v: &mut Vector3<f64>) {
        let sine = self.wave.sine(state.q_rad[self.joint]);
        voltage_v[self.joint] += cogging_v(self.amplitude_v, sine);
    }
}
