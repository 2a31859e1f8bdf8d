//! Friction that changes as the joint warms.

use model::friction::FrictionScale;

use crate::effects::{
    Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search, Size, Touches,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "friction_drift",
    words: "friction changes as the joint warms up",
    equation: "gamma and alpha2 times 1 + e (1 - exp(-t/T))",
    whole_robot: false,
    parameters: &[
        Parameter::new("relative_change", Kind::RelativeChange, -0.9, 2.0),
        Parameter::new("time_constant_s", Kind::TimeConstant, 0.1, 10000.0),
    ],
    couples_joints: false,
    touches: Touches::FRICTION,
    search: Search::From(|_| [1.0, 5.0, 30.0].map(|time_s| vec![0.2, time_s]).to_vec()),
    size: Size::grows(|_| 0.8),
    draw: |_, random| vec![random.signed_log_uniform(0.15, 0.6), random.uniform(2.0, 10.0)],
    confused_with: &[Confusion::effect(
        "load_friction",
        "both change friction slowly while the motion goes on",
        "the same motion cold and warm",
    )],
    compensation: Compensation::None("the board does not know how warm the joint is"),
    experiment: "one motion repeated, cold and warm",
    build: |joint, values| {
        Box::new(FrictionDrift {
            joint: usize::from(joint) - 1,
            relative_change: values[0],
            time_constant_s: values[1],
        })
    },
};

#[derive(Clone, Debug)]
struct FrictionDrift {
    joint: usize,
    relative_change: f64,
    time_constant_s: f64,
}

impl Effect for FrictionDrift {
    fn change_friction(&self, state: &JointState, scale: &mut [FrictionScale<f64>]) {
        let warmed = -(-state.time_s / self.time_constant_s).exp_m1();
        let factor = 1.0 + self.relative_change * warmed;
        scale[self.joint].level *= factor;
        scale[self.joint].viscous *= factor;
    }
}
