//! A joint's equation of motion along the measured motion of the arm.

use crate::logs::kinematics::{Joints, Kinematics};
use rig::effects::Transmission;
use rig::plant::Body;

/// Difference for slopes of the bias torque [rad, rad/s].
pub(super) const STEP: f64 = 1e-4;

/// Equation of motion of a joint at a sample, the other joints moving as measured: its inertia
/// times its acceleration is the torque on it less a bias.
#[derive(Clone, Copy, Debug)]
pub struct JointDynamics {
    pub(super) inertia_kg_m2: f64,
    /// Torque that it needs without acceleration of its own, at the motor's angle: gravity,
    /// Coriolis, and the accelerations of the other joints.
    pub(super) bias_nm: f64,
    /// Slopes of that torque along the joint's own angle and velocity: a link is a little
    /// away from its motor, and gravity's slope shifts the resonance.
    along_angle_nm: f64,
    along_velocity_nm_s: f64,
}

impl JointDynamics {
    /// At every sample of a motion.
    pub fn along(joint: usize, motor: &Kinematics, body: &Body) -> Vec<Self> {
        (0..motor.q_rad[joint].len()).map(|k| Self::at(joint, motor, body, k)).collect()
    }

    fn at(joint: usize, motor: &Kinematics, body: &Body, k: usize) -> Self {
        let [q, qd, mut qdd] = motor.state(k);
        qdd[joint] = 0.0;
        let bias_nm = |q: &Joints, qd: &Joints| {
            let mut torque_nm = Joints::default();
            body.inverse_dynamics(q, qd, &qdd, &mut torque_nm);
            torque_nm[joint]
        };
        let (mut q_moved, mut qd_moved) = (q, qd);
        q_moved[joint] += STEP;
        qd_moved[joint] += STEP;
        let here_nm = bias_nm(&q, &qd);
        Self {
            inertia_kg_m2: body.inertia(joint, &q),
            bias_nm: here_nm,
            along_angle_nm: (bias_nm(&q_moved, &qd) - here_nm) / STEP,
            along_velocity_nm_s: (bias_nm(&q, &qd_moved) - here_nm) / STEP,
        }
    }

    /// Without the motor's inertia, which enters nothing but the joint's own.
    pub(super) fn without_motor(&self, spring: &Transmission) -> Self {
        Self { inertia_kg_m2: self.inertia_kg_m2 - spring.motor_inertia_kg_m2, ..*self }
    }

    /// Part `x` of the way to another sample.
    pub(super) fn towards(&self, other: &Self, x: f64) -> Self {
        let between = |here: f64, there: f64| here + x * (there - here);
        Self {
            inertia_kg_m2: between(self.inertia_kg_m2, other.inertia_kg_m2),
            bias_nm: between(self.bias_nm, other.bias_nm),
            along_angle_nm: between(self.along_angle_nm, other.along_angle_nm),
            along_velocity_nm_s: between(self.along_velocity_nm_s, other.along_velocity_nm_s),
        }
    }

    /// With the link ahead of its motor by `ahead_rad` and `ahead_rad_per_s`.
    pub(super) fn with_link_ahead(&self, ahead_rad: f64, ahead_rad_per_s: f64) -> Self {
        let bias_nm = self.bias_nm
            + self.along_angle_nm * ahead_rad
            + self.along_velocity_nm_s * ahead_rad_per_s;
        Self { bias_nm, ..*self }
    }

    /// Acceleration under a torque [rad/s^2].
    pub(super) fn acceleration(&self, torque_nm: f64) -> f64 {
        (torque_nm - self.bias_nm) / self.inertia_kg_m2
    }
}
