//! Friction that differs between the directions.

use firmware::compensation::{Feedforward, limits};
use model::effects::scale_asymmetric_friction;
use model::friction::FrictionScale;

use crate::effects::{
    Compensation, Definition, Effect, JointState, Kind, Parameter, Search, Size, Touches,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "asymmetric_friction",
    words: "friction is stronger one way than the other",
    equation: "gamma and alpha2 times 1 + e forwards, 1 - e backwards",
    whole_robot: false,
    parameters: &[Parameter::of_board(
        "relative_asymmetry",
        Kind::RelativeChange,
        limits::FRICTION_ASYMMETRY,
    )],
    couples_joints: false,
    touches: Touches::FRICTION,
    search: Search::From(|_| vec![vec![0.1]]),
    size: Size::grows(|_| 0.8),
    draw: |_, random| vec![random.signed_log_uniform(0.1, 0.4)],
    confused_with: &[],
    compensation: Compensation::Feedforward(|values| {
        Ok(Feedforward::AsymmetricFriction { relative_asymmetry: values[0] as f32 })
    }),
    experiment: "motion both ways at many speeds (`rrr run excitation`)",
    build: |joint, values| {
        Box::new(AsymmetricFriction {
            joint: usize::from(joint) - 1,
            relative_asymmetry: values[0],
        })
    },
};

#[derive(Clone, Debug)]
struct AsymmetricFriction {
    joint: usize,
    relative_asymmetry: f64,
}

impl Effect for AsymmetricFriction {
    fn change_friction(&self, state: &JointState, scale: &mut [FrictionScale<f64>]) {
        let velocity = state.qd_rad_per_s[self.joint];
        scale_asymmetric_friction(&mut scale[self.joint], self.relative_asymmetry, velocity);
    }
}
