//! Cables that pull the joint towards a rest angle.

use firmware::compensation::{Feedforward, limits};
use model::HANGING_RAD;
use model::effects::cable_spring_v;

use crate::effects::{
    Compensation, Confusion, Definition, Effect, JointState, Kind, Parameter, Search, Size, Touches,
};

pub(super) const DEFINITION: Definition = Definition {
    name: "cable_spring",
    words: "cables pull the joint back to a rest angle",
    equation: "u - k (q - q0)",
    whole_robot: false,
    parameters: &[
        Parameter::of_board(
            "stiffness_V_per_rad",
            Kind::Stiffness,
            limits::CABLE_STIFFNESS_V_PER_RAD,
        ),
        Parameter::of_board("rest_rad", Kind::Angle, limits::CABLE_REST_RAD),
    ],
    couples_joints: false,
    touches: Touches::DRIVE,
    // A spring at rest far away pulls one way only.
    search: Search::From(|typical| {
        let start = |away_rad| vec![0.1 * typical.friction_v, typical.position_rad + away_rad];
        [0.0, -1.0, 1.0].map(start).to_vec()
    }),
    size: Size::grows(|typical| typical.friction_v),
    draw: |context, random| {
        // At rest near the posture about which motions are made.
        let stiffness = random.log_uniform(0.05, 0.5);
        vec![stiffness, HANGING_RAD[context.joint] + random.uniform(-1.0, 1.0)]
    },
    confused_with: &[Confusion::model(
        "gravity's slope",
        "a straight line and a sine agree over less than a radian",
        "motion over more than a turn",
    )],
    compensation: Compensation::Feedforward(|values| {
        let [stiffness_v_per_rad, rest_rad] = [values[0] as f32, values[1] as f32];
        Ok(Feedforward::CableSpring { stiffness_v_per_rad, rest_rad })
    }),
    experiment: "slow motion over more than a turn",
    build: |joint, values| {
        Box::new(CableSpring {
            joint: usize::from(joint) - 1,
            stiffness_v_per_rad: values[0],
            rest_rad: values[1],
        })
    },
};

/// On an arm of any kind, whose commands may be newtons or amperes.
pub(super) const OF_ARM: Definition = Definition {
    parameters: &[
        Parameter::new("stiffness_V_per_rad", Kind::Stiffness, 0.0, 1e5),
        Parameter::of_board("rest_rad", Kind::Angle, limits::CABLE_REST_RAD),
    ],
    ..DEFINITION
};

#[derive(Clone, Debug)]
struct CableSpring {
    joint: usize,
    stiffness_v_per_rad: f64,
    rest_rad: f64,
}

impl Effect for CableSpring {
    fn add_voltage(&self, state: &JointState, voltage_v: &mut [f64]) {
        let q_rad = state.q_rad[self.joint];
        voltage_v[self.joint] += cable_spring_v(self.stiffness_v_per_rad, q_rad, self.rest_rad);
    }
}
