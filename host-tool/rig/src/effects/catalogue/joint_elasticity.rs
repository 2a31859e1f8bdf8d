//! A joint that gives way.

use crate::effects::{
    Compensation, Confusion, Definition, Effect, Kind, Parameter, Search, Size, Touches,
    Transmission, Typical,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "joint_elasticity",
    words: "motor and link are joined by a spring",
    equation: "k (theta - q) + d (theta' - q'), encoder and friction at the motor theta",
    whole_robot: false,
    parameters: &[
        Parameter::new("stiffness_Nm_per_rad", Kind::Stiffness, 1.0, 1e6),
        Parameter::new("damping_Nm_s_per_rad", Kind::Damping, 0.0, 1e3),
        Parameter::new("motor_inertia_kg_m2", Kind::Inertia, 1e-5, 10.0),
    ],
    couples_joints: true,
    touches: Touches::BODY,
    search: Search::From(starts),
    size: Size::shrinks(|typical| typical.spring(2.0, 0.2)[0]),
    draw: |context, random| context.spring(random, 8.0, 40.0).to_vec(),
    confused_with: &[
        Confusion::effect(
            "backlash",
            "a gap that is small against the spring's own give is a spring; both ring",
            "noise in the command at two amplitudes: the resonance of backlash moves with amplitude, that of a spring does not",
        ).never_paired(),
    ],
    compensation: Compensation::None("the encoder sees the motor, not the link"),
    experiment: "noise in the command up to the resonance (`rrr run driven-noise` reaches 200 Hz)",
    build: |joint, values| {
        let transmission = Transmission {
            gap_rad: 0.0,
            stiffness_nm_per_rad: values[0],
            damping_nm_s_per_rad: values[1],
            motor_inertia_kg_m2: values[2],
        };
        Box::new(JointElasticity { joint: usize::from(joint) - 1, transmission })
    },
};

/// Resonances with the motor held, as the logs may show them, lightly damped.
fn starts(typical: &Typical) -> Vec<Vec<f64>> {
    const MOTOR_PART: f64 = 0.17;
    let spring = |resonance_hz| typical.spring(resonance_hz, MOTOR_PART).to_vec();
    [7.0, 12.0, 20.0, 35.0].map(spring).to_vec()
}

#[derive(Clone, Debug)]
struct JointElasticity {
    joint: usize,
    transmission: Transmission,
}

impl Effect for JointElasticity {
    fn transmission(&self) -> Option<(usize, Transmission)> {
        Some((self.joint, self.transmission))
    }
}
