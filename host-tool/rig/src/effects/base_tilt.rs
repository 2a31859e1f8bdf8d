//! A base that does not stand level.

use model::effects::Tilt;
use model::vector::Vector3;
use model::{Posture, Robot};

use super::{Definition, Effect, JointState, Parameter, Search, Size, Touches};

pub(super) const DEFINITION: Definition = Definition {
    name: "base_tilt",
    words: "the base leans, so gravity does not point along the first axis",
    equation: "gravity g (sin b, -sin a cos b, -cos a cos b) in the base frame",
    whole_robot: true,
    parameters: &[
        Parameter::new("tilt_x_rad", -0.5, 0.5),
        Parameter::new("tilt_y_rad", -0.5, 0.5),
        Parameter::optional("hidden_moment_reach_kg_m", -10.0, 10.0),
        Parameter::optional("hidden_moment_side_kg_m", -10.0, 10.0),
    ],
    couples_joints: true,
    touches: Touches::DRIVE,
    search: Search::From(|_| vec![vec![0.02, 0.02, 0.1, 0.1]]),
    size: Size::grows(|_| 0.2),
    experiment: "`rrr run excitation`, joint 1 over a whole turn",
    build: |_, values| {
        let tilt = Tilt::new(values[0], values[1], [values[2], values[3]]);
        Box::new(BaseTilt { tilt })
    },
};

#[derive(Clone, Debug)]
struct BaseTilt {
    tilt: Tilt<f64>,
}

impl Effect for BaseTilt {
    /// What gravity does beyond what it does to a level base.
    fn add_torque(&self, state: &JointState, robot: &Robot<f64>, torque_nm: &mut Vector3<f64>) {
        let [q1, q2, q3] = state.q_rad;
        let Robot { base, geometry, .. } = robot;
        let leaning = self.tilt.torque(q1.sin_cos(), &Posture::new(q2, q3), base, geometry);
        for joint in 0..3 {
            torque_nm[joint] += leaning[joint];
        }
    }
}
