//! Viscous friction that differs between the directions.

use model::friction::FrictionScale;

use crate::effects::{
    Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search, Size, Touches,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "viscous_asymmetry",
    words: "viscous friction is stronger one way than the other",
    equation: "alpha2 times 1 + e forwards, 1 - e backwards",
    whole_robot: false,
    parameters: &[Parameter::new("relative_asymmetry", Kind::RelativeChange, -0.95, 0.95)],
    couples_joints: false,
    touches: Touches::FRICTION,
    search: Search::From(|_| vec![vec![0.1]]),
    size: Size::grows(|_| 0.8),
    draw: |_, random| vec![random.signed_log_uniform(0.1, 0.4)],
    confused_with: &[
        Confusion::effect(
            "asymmetric_friction",
            "at one speed both are a constant that turns with the direction",
            "constant velocities both ways at several speeds",
        )
        .compared(),
        Confusion::effect(
            "dac_offset",
            "at one speed both are a constant while the joint goes one way",
            "constant velocities both ways at several speeds",
        )
        .compared(),
    ],
    compensation: Compensation::None("it scales Coulomb and viscous friction alike"),
    experiment: "motion both ways at many speeds (`rrr run excitation`)",
    build: |joint, values| {
        Box::new(ViscousAsymmetry { joint: usize::from(joint) - 1, relative_asymmetry: values[0] })
    },
};

#[derive(Clone, Debug)]
struct ViscousAsymmetry {
    joint: usize,
    relative_asymmetry: f64,
}

impl Effect for ViscousAsymmetry {
    fn change_friction(&self, state: &JointState, scale: &mut [FrictionScale<f64>]) {
        let backwards = state.qd_rad_per_s[self.joint] < 0.0;
        let sign = if backwards { -1.0 } else { 1.0 };
        scale[self.joint].viscous *= 1.0 + sign * self.relative_asymmetry;
    }
}
