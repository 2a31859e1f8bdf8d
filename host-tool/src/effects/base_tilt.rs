//! A base that does not stand level.

use model::vector::Vector3;
use model::{BaseParameters, Posture, Robot};

use super::{Definition, Effect, Moment, Parameter, Search, Size, Touches};

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
        Box::new(BaseTilt {
            direction: direction(values[0], values[1]),
            hidden_kg_m: [values[2], values[3]],
        })
    },
};

/// Gravity's direction in the base frame, which leans by a about x and by b about y.
fn direction(a: f64, b: f64) -> Vector3<f64> {
    [b.sin(), -a.sin() * b.cos(), -a.cos() * b.cos()]
}

#[derive(Clone, Debug)]
struct BaseTilt {
    direction: Vector3<f64>,
    /// First moments about axis 1 that a level base hides, along the reach and aside.
    hidden_kg_m: [f64; 2],
}

impl Effect for BaseTilt {
    /// What gravity does beyond what it does to a level base.
    ///
    /// The first moments along joint axis 2 and of link 1 are not among the 16 base
    /// parameters, because a level base hides them; they are parameters of the effect.
    fn add_torque(&self, moment: &Moment, robot: &Robot<f64>, torque_nm: &mut Vector3<f64>) {
        let [x, y, up] = self.direction;
        let (s1, c1) = moment.q_rad[0].sin_cos();
        let (along, across) = (c1 * x + s1 * y, c1 * y - s1 * x);
        let posture = Posture::new(moment.q_rad[1], moment.q_rad[2]);
        let (arm, forearm) = moments(&posture, &robot.base);
        let g = robot.geometry.gravity_m_s2;
        let [reach, side] = self.hidden_kg_m;
        torque_nm[0] += g * (across * (arm.level + forearm.level + reach) - along * side);
        for (joint, part) in [(1, arm.plus(forearm)), (2, forearm)] {
            torque_nm[joint] += g * ((up + 1.0) * part.level - along * part.upright);
        }
    }
}

/// First moment of a part of the arm, level and upright [kg m].
#[derive(Clone, Copy)]
struct FirstMoment {
    level: f64,
    upright: f64,
}

impl FirstMoment {
    fn plus(self, other: Self) -> Self {
        Self { level: self.level + other.level, upright: self.upright + other.upright }
    }
}

/// Of link 2 (with link 3's mass at the elbow) and of link 3.
fn moments(posture: &Posture<f64>, p: &BaseParameters<f64>) -> (FirstMoment, FirstMoment) {
    let Posture { s2, c2, s23, c23, .. } = *posture;
    let turned = |x: f64, y: f64, (s, c): (f64, f64)| FirstMoment {
        level: x * c - y * s,
        upright: x * s + y * c,
    };
    (turned(p.mx2r, p.my2r, (s2, c2)), turned(p.mx3r, p.my3r, (s23, c23)))
}
