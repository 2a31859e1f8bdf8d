//! Friction that is higher near standstill than the model says.

use model::friction::FrictionScale;

use crate::effects::{
    Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search, Size, Touches,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "stribeck",
    words: "friction has a peak near standstill that the model lacks",
    equation: "gamma + alpha1 exp(-(qd / v_s)^2)",
    whole_robot: false,
    parameters: &[
        Parameter::new("alpha1_V", Kind::Coefficient, 0.0, 1000.0),
        Parameter::new("stribeck_velocity_rad_per_s", Kind::Coefficient, 1e-6, 100.0),
    ],
    couples_joints: false,
    touches: Touches::FRICTION,
    search: Search::From(|typical| {
        let start = |part: f64| vec![0.3 * typical.friction_v, part * typical.speed_rad_per_s];
        [0.2, 0.05].map(start).to_vec()
    }),
    size: Size::grows(|typical| typical.friction_v),
    draw: |_, random| vec![random.log_uniform(0.02, 0.2), random.log_uniform(0.01, 0.2)],
    confused_with: &[
        Confusion::model(
            "alpha1 and the Stribeck velocity",
            "a refit of the model's own friction takes up a peak as narrow as its own, and the \
             report names it among the parameters that changed",
            "nothing: they are one thing; a peak that is wider than the model's is named",
        ),
        Confusion::effect(
            "quadratic_drag",
            "a wide peak falls with speed as degressive friction does",
            "constant velocities from slow to fast (`rrr run constant-velocity`)",
        )
        .compared(),
    ],
    compensation: Compensation::None("it compensates for the model's own friction"),
    experiment: "slow motion and motion ten times as fast (`rrr run slow` and `rrr run excitation`)",
    build: |joint, values| {
        Box::new(Stribeck {
            joint: usize::from(joint) - 1,
            alpha1_v: values[0],
            velocity_rad_per_s: values[1],
        })
    },
};

#[derive(Clone, Debug)]
struct Stribeck {
    joint: usize,
    alpha1_v: f64,
    velocity_rad_per_s: f64,
}

impl Effect for Stribeck {
    fn change_friction(&self, state: &JointState, scale: &mut [FrictionScale<f64>]) {
        let part = state.qd_rad_per_s[self.joint] / self.velocity_rad_per_s;
        scale[self.joint].added_v += self.alpha1_v * (-part * part).exp();
    }
}
