//! What a link behind a spring pulls at all joints, by slopes about the measured motion.
//!
//! A link is a little ahead of its motor or behind it. To first order the torques of all joints change by the
//! inertias, and by the slopes of the other torques, that belong to its joint; the link's own motion is integrated by
//! the same slopes.

use crate::logs::kinematics::{Kinematics, Sines};
use crate::logs::torque_slopes::TorqueSlopes;
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
    /// Those along a joint's motion; `sines` are those of its angles, for a chain.
    pub fn along(joint: usize, motor: &Kinematics, sines: &[Sines], body: &Body) -> Self {
        let (count, samples) = (body.joints(), motor.q_rad[joint].len());
        let empty = || vec![Vec::with_capacity(samples); count];
        let (inertia_kg_m2, along_angle_nm, along_velocity_nm_s) = (empty(), empty(), empty());
        let mut coupling = Self { inertia_kg_m2, along_angle_nm, along_velocity_nm_s };
        TorqueSlopes::along(joint, motor, sines, body).for_each(|slopes| coupling.push(&slopes));
        coupling
    }

    fn push(&mut self, slopes: &TorqueSlopes) {
        for i in 0..self.inertia_kg_m2.len() {
            self.inertia_kg_m2[i].push(slopes.inertia_kg_m2[i]);
            self.along_angle_nm[i].push(slopes.along_angle_nm[i]);
            self.along_velocity_nm_s[i].push(slopes.along_velocity_nm_s[i]);
        }
    }

    /// Change of a joint's torque at a sample, with the link ahead by this acceleration, angle and velocity [Nm].
    pub(super) fn torque_nm(&self, joint: usize, k: usize, [qdd, q, qd]: [f64; 3]) -> f64 {
        self.inertia_kg_m2[joint][k] * qdd
            + self.along_angle_nm[joint][k] * q
            + self.along_velocity_nm_s[joint][k] * qd
    }
}
