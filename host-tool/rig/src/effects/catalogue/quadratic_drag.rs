//! Drag that grows with the square of speed.

use firmware::compensation::{Feedforward, limits};
use model::effects::quadratic_drag_v;

use crate::effects::{
    Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search, Size, Touches,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "quadratic_drag",
    words: "air or a fan drags with the square of speed",
    equation: "u - b qd |qd|",
    whole_robot: false,
    parameters: &[Parameter::of_board(
        "coefficient_V_s2_per_rad2",
        Kind::Coefficient,
        limits::QUADRATIC_DRAG_V_S2_PER_RAD2,
    )],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::From(|typical| {
        vec![vec![0.1 * typical.friction_v / typical.speed_rad_per_s.powi(2)]]
    }),
    size: Size::grows(|typical| typical.friction_v / typical.speed_rad_per_s.powi(2)),
    draw: |_, random| vec![random.log_uniform(0.003, 0.05)],
    confused_with: &[
        Confusion::effect(
            "friction_drift",
            "both change friction slowly while the motion goes on",
            "the same motion cold and warm",
        )
        .compared(),
        Confusion::model(
            "viscous friction",
            "over less than a decade of speeds a square is nearly a line",
            "constant velocities from slow to fast (`rrr run constant-velocity`)",
        ),
    ],
    compensation: Compensation::Feedforward(|values| {
        Ok(Feedforward::QuadraticDrag { coefficient_v_s2_per_rad2: values[0] as f32 })
    }),
    experiment: "motion at speeds ten times apart (`rrr run slow` and `rrr run excitation`)",
    build: |joint, values| {
        Box::new(QuadraticDrag {
            joint: usize::from(joint) - 1,
            coefficient_v_s2_per_rad2: values[0],
        })
    },
};

/// On an arm of any kind: negative where friction grows less than with the velocity.
pub(super) const OF_ARM: Definition = Definition {
    words: "air drags with the square of speed, or viscous friction grows less than with speed",
    equation: "u - b qd |qd|, b negative where friction is degressive",
    // Newtons over the square of a slow axis' metres per second are many.
    parameters: &[Parameter::new("coefficient_V_s2_per_rad2", Kind::Coefficient, -1e6, 1e6)],
    compensation: Compensation::None("the board drives another arm"),
    ..DEFINITION
};

#[derive(Clone, Debug)]
struct QuadraticDrag {
    joint: usize,
    coefficient_v_s2_per_rad2: f64,
}

impl Effect for QuadraticDrag {
    fn add_voltage(&self, state: &JointState, voltage_v: &mut [f64]) {
        let speed = state.qd_rad_per_s[self.joint];
        voltage_v[self.joint] += quadratic_drag_v(self.coefficient_v_s2_per_rad2, speed);
    }
}
