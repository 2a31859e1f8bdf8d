//! Cables that pull the joint towards a rest angle.

use model::effects::cable_spring_v;
use model::vector::Vector3;

use super::{Definition, Effect, JointState, Parameter, Search, Size, Touches};

pub(super) const DEFINITION: Definition = Definition {
    name: "cable_spring",
    words: "cables pull the joint back to a rest angle",
    equation: "u - k (q - q0)",
    whole_robot: false,
    parameters: &[
        Parameter::new("stiffness_V_per_rad", 0.0, 10.0),
        Parameter::new("rest_rad", -100.0, 100.0),
    ],
    couples_joints: false,
    touches: Touches::DRIVE,
    search: Search::From(|typical| vec![vec![0.1 * typical.friction_v, typical.position_rad]]),
    size: Size::grows(|typical| typical.friction_v),
    experiment: "`rrr run slow` over more than a turn",
    build: |joint, values| {
        Box::new(CableSpring {
            joint: usize::from(joint) - 1,
            stiffness_v_per_rad: values[0],
            rest_rad: values[1],
        })
    },
};

#[derive(Clone, Debug)]
struct CableSpring {
    joint: usize,
    stiffness_v_per_rad: f64,
    rest_rad: f64,
}

impl Effect for CableSpring {
    fn add_voltage(&self, state: &JointState, voltage_v: &mut Vector3<f64>) {
        let q_rad = state.q_rad[self.joint];
        voltage_v[self.joint] += cable_spring_v(self.stiffness_v_per_rad, q_rad, self.rest_rad);
    }
}
