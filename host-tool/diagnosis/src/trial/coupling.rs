//! What a link behind a spring pulls at all joints, by slopes about the measured motion.
//!
//! A link is a little ahead of its motor or behind it. To first order the torques of all joints change by the
//! inertias, and by the slopes of the other torques, that belong to its joint; the link's own motion is integrated by
//! the same slopes.

use model::chain::MAX_JOINTS;

use super::joint_dynamics::STEP;
use crate::logs::kinematics::{Joints, Kinematics};
use rig::plant::Body;

/// Slopes of the torques of all joints along one joint's acceleration, angle and velocity; joint by joint, at the
/// samples.
#[derive(Clone, Debug, Default)]
pub struct Coupling {
    inertia_kg_m2: Vec<Vec<f64>>,
    along_angle_nm: Vec<Vec<f64>>,
    along_velocity_nm_s: Vec<Vec<f64>>,
}

impl Coupling {
    /// Those along a joint's motion.
    pub fn along(joint: usize, motor: &Kinematics, body: &Body) -> Self {
        let (count, samples) = (body.joints(), motor.q_rad[joint].len());
        let empty = || vec![Vec::with_capacity(samples); count];
        let (inertia_kg_m2, along_angle_nm, along_velocity_nm_s) = (empty(), empty(), empty());
        let mut coupling = Self { inertia_kg_m2, along_angle_nm, along_velocity_nm_s };
        for k in 0..samples {
            coupling.push(joint, &motor.state(k), body);
        }
        coupling
    }

    fn push(&mut self, joint: usize, [q, qd, qdd]: &[Joints; 3], body: &Body) {
        let count = body.joints();
        let torques = |q: &Joints, qd: &Joints| {
            let mut torque_nm = Joints::default();
            body.inverse_dynamics(q, qd, qdd, &mut torque_nm);
            torque_nm
        };
        let (mut q_moved, mut qd_moved) = (*q, *qd);
        q_moved[joint] += STEP;
        qd_moved[joint] += STEP;
        let (here, by_angle, by_velocity) =
            (torques(q, qd), torques(&q_moved, qd), torques(q, &qd_moved));
        let mut mass = [0.0; MAX_JOINTS * MAX_JOINTS];
        body.mechanism().mass_matrix(q, &mut mass);
        for i in 0..count {
            self.inertia_kg_m2[i].push(mass[i * count + joint]);
            self.along_angle_nm[i].push((by_angle[i] - here[i]) / STEP);
            self.along_velocity_nm_s[i].push((by_velocity[i] - here[i]) / STEP);
        }
    }

    /// Change of a joint's torque at a sample, with the link ahead by this acceleration, angle and velocity [Nm].
    pub(super) fn torque_nm(&self, joint: usize, k: usize, [qdd, q, qd]: [f64; 3]) -> f64 {
        self.inertia_kg_m2[joint][k] * qdd
            + self.along_angle_nm[joint][k] * q
            + self.along_velocity_nm_s[joint][k] * qd
    }
}
