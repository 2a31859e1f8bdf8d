//! A constant force on the tip.

use model::vector::Vector3;
use model::{Posture, Robot};

use super::{Definition, Effect, Moment, Parameter, Search, Size, Touches};

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
    /// J^T F with the force turned into the arm's plane: along the reach, across it, up.
    fn add_torque(&self, moment: &Moment, robot: &Robot<f64>, torque_nm: &mut Vector3<f64>) {
        let [x, y, up] = self.force_n;
        let (s1, c1) = moment.q_rad[0].sin_cos();
        let (along, across) = (c1 * x + s1 * y, c1 * y - s1 * x);
        let Posture { s2, c2, s23, c23, .. } = Posture::new(moment.q_rad[1], moment.q_rad[2]);
        let g = &robot.geometry;
        let (reach, height) = (g.a2_m * c2 + g.a3_m * c23, g.a2_m * s2 + g.a3_m * s23);
        torque_nm[0] += (g.d2_m + g.d3_m) * along + reach * across;
        torque_nm[1] += reach * up - height * along;
        torque_nm[2] += g.a3_m * (c23 * up - s23 * along);
    }
}
