//! A constant force on the tip.

use model::vector::Vector3;
use model::{Posture, Robot};

use super::{Definition, Effect, JointState, Parameter, Search, Size, Touches};

const COMPONENT: Parameter = Parameter::new("force_N", -200.0, 200.0);

pub(super) const DEFINITION: Definition = Definition {
    name: "tip_force",
    words: "the surroundings push the tip with a constant force",
    equation: "torque + J^T F, F in the base frame",
    whole_robot: true,
    parameters: &[COMPONENT, COMPONENT, COMPONENT],
    couples_joints: true,
    touches: Touches::DRIVE,
    search: Search::From(|_| vec![vec![1.0, 1.0, 1.0]]),
    size: Size::grows(|_| 50.0),
    experiment: "`rrr run excitation` with all three joints",
    build: |_, values| Box::new(TipForce { force_n: [values[0], values[1], values[2]] }),
};

#[derive(Clone, Debug)]
struct TipForce {
    force_n: Vector3<f64>,
}

impl Effect for TipForce {
    fn add_torque(&self, state: &JointState, robot: &Robot<f64>, torque_nm: &mut Vector3<f64>) {
        let [q1, q2, q3] = state.q_rad;
        let posture = Posture::new(q2, q3);
        let pushed = posture.tip_force_torque(q1.sin_cos(), &robot.geometry, &self.force_n);
        for joint in 0..3 {
            torque_nm[joint] += pushed[joint];
        }
    }
}
