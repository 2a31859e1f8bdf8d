//! Torques along a motion, and how they change as one joint moves otherwise.

use model::Real;
use model::chain::MAX_JOINTS;

use super::kinematics::{Joints, Kinematics, Sines};
use rig::plant::Body;

/// Difference for slopes along an angle and a velocity [rad, rad/s].
const STEP: f64 = 1e-4;

/// Torques of all joints at a sample, and their slopes along one joint's acceleration, angle and velocity.
#[derive(Clone, Copy, Debug)]
pub struct TorqueSlopes {
    /// Torques of the motion, eq. (5) [Nm].
    pub here_nm: Joints,
    /// Slopes along the joint's acceleration: its column of the mass matrix.
    pub inertia_kg_m2: Joints,
    /// Along its angle.
    pub along_angle_nm: Joints,
    /// Along its velocity.
    pub along_velocity_nm_s: Joints,
}

impl TorqueSlopes {
    /// Those of a body along a joint (from 0), by samples; `sines` are those of the motion, for a chain.
    pub fn along<'a>(
        joint: usize,
        motion: &'a Kinematics,
        sines: &'a [Sines],
        body: &'a Body,
    ) -> impl Iterator<Item = Self> + 'a {
        let mut at_sample = [(0.0, 1.0); MAX_JOINTS];
        (0..motion.q_rad[joint].len()).map(move |k| {
            at_sample.iter_mut().zip(sines).for_each(|(at, of_joint)| *at = of_joint[k]);
            Self::at(joint, motion.state(k), at_sample, body)
        })
    }

    /// Torque is linear in acceleration: a unit of it tells the slope.
    fn at(
        joint: usize,
        [q, qd, qdd]: [Joints; 3],
        sines: [(f64, f64); MAX_JOINTS],
        body: &Body,
    ) -> Self {
        let moved = |of: &Joints, by: f64| {
            let mut moved = *of;
            moved[joint] += by;
            moved
        };
        let (q_moved, mut sines_moved) = (moved(&q, STEP), sines);
        sines_moved[joint] = Real::sin_cos(q_moved[joint]);
        let here_nm = torques(body, &sines, [&q, &qd, &qdd]);
        let slope = |torques_nm: Joints, step: f64| {
            let mut slope = torques_nm;
            slope.iter_mut().zip(here_nm).for_each(|(slope, here)| *slope = (*slope - here) / step);
            slope
        };
        Self {
            here_nm,
            inertia_kg_m2: slope(torques(body, &sines, [&q, &qd, &moved(&qdd, 1.0)]), 1.0),
            along_angle_nm: slope(torques(body, &sines_moved, [&q_moved, &qd, &qdd]), STEP),
            along_velocity_nm_s: slope(torques(body, &sines, [&q, &moved(&qd, STEP), &qdd]), STEP),
        }
    }
}

/// Torques of a motion [Nm].
fn torques(body: &Body, sines: &[(f64, f64); MAX_JOINTS], [q, qd, qdd]: [&Joints; 3]) -> Joints {
    let mut torques_nm = Joints::default();
    match body {
        Body::Rrr(_) => body.inverse_dynamics(q, qd, qdd, &mut torques_nm),
        Body::Chain(linked) => {
            linked.chain.inverse_dynamics_with_sines(sines, q, qd, qdd, &mut torques_nm);
        }
    }
    torques_nm
}

#[cfg(test)]
mod tests {
    use files::example_arms::{linear_axis, six_axes};
    use rig::Plant;

    use super::*;

    /// A motion of one sample in which every joint stands, moves and speeds up otherwise.
    fn motion(joints: usize) -> Kinematics {
        let each = |of: fn(f64) -> f64| (0..joints).map(|k| vec![of(k as f64)]).collect::<Vec<_>>();
        let q_rad = each(|k| 0.4 - 0.3 * k);
        let raw_rad = q_rad.clone();
        let (qd_rad_per_s, qdd_rad_per_s2) = (each(|k| 0.7 + 0.2 * k), each(|k| 3.0 - 1.1 * k));
        Kinematics { raw_rad, q_rad, qd_rad_per_s, qdd_rad_per_s2 }
    }

    fn moved(of: Joints, joint: usize, by: f64) -> Joints {
        let mut moved = of;
        moved[joint] += by;
        moved
    }

    #[test]
    fn slopes_are_the_mass_matrix_and_central_differences() {
        for arm in [six_axes(), linear_axis()] {
            let body = Plant::of_arm(&arm).unwrap().body;
            let (count, motion) = (body.joints(), motion(body.joints()));
            let (sines, [q, qd, qdd]) = (motion.sines(), motion.state(0));
            let mut mass = [0.0; MAX_JOINTS * MAX_JOINTS];
            body.mechanism().mass_matrix(&q, &mut mass);
            let torque_nm = |q: Joints, qd: Joints| {
                let mut torques_nm = Joints::default();
                body.inverse_dynamics(&q, &qd, &qdd, &mut torques_nm);
                torques_nm
            };
            for joint in 0..count {
                let slopes = TorqueSlopes::along(joint, &motion, &sines, &body).next().unwrap();
                let by_angle = [1e-4, -1e-4].map(|by| torque_nm(moved(q, joint, by), qd));
                let by_velocity = [1e-4, -1e-4].map(|by| torque_nm(q, moved(qd, joint, by)));
                for i in 0..count {
                    let near = |found: f64, wanted: f64, within: f64| {
                        assert!((found - wanted).abs() < within, "{joint} {i}: {found} {wanted}");
                    };
                    near(slopes.inertia_kg_m2[i], mass[i * count + joint], 1e-9);
                    let slope = |[up, down]: [Joints; 2]| (up[i] - down[i]) / 2e-4;
                    near(slopes.along_angle_nm[i], slope(by_angle), 0.05);
                    near(slopes.along_velocity_nm_s[i], slope(by_velocity), 0.01);
                }
            }
        }
    }
}
