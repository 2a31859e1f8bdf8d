//! Friction that varies over the turn.

use model::effects::{AngularHarmonic, scale_position_friction};
use model::friction::FrictionScale;

use super::{Carrier, Definition, Effect, JointState, Parameter, Search, Size, Touches};

pub(super) const DEFINITION: Definition = Definition {
    name: "position_friction",
    words: "the friction level varies over the turn",
    equation: "gamma (1 + a sin(n q + phi))",
    whole_robot: false,
    parameters: &[
        Parameter::new("relative_amplitude", 0.0, 0.95),
        Parameter::new("harmonic", 1.0, 1000.0),
        Parameter::new("phase_rad", -6.3, 6.3),
    ],
    couples_joints: false,
    touches: Touches::FRICTION,
    search: Search::Harmonics(Carrier::Friction),
    size: Size::grows(|_| 0.8),
    experiment: "`rrr run slow` over a whole turn",
    build: |joint, values| {
        Box::new(PositionFriction {
            joint: usize::from(joint) - 1,
            relative_amplitude: values[0],
            wave: AngularHarmonic { order: values[1], phase_rad: values[2] },
        })
    },
};

#[derive(Clone, Debug)]
struct PositionFriction {
    joint: usize,
    relative_amplitude: f64,
    wave: AngularHarmonic<f64>,
}

impl Effect for PositionFriction {
    fn change_friction(&self, state: &JointState, scale: &mut [FrictionScale<f64>; 3]) {
        let sine = self.wave.sine(state.q_rad[self.joint]);
        scale_position_friction(&mut scale[self.joint], self.relative_amplitude, sine);
    }
}
