//! A joint's equation of motion along the measured motion of the arm.

use super::kinematics::{Kinematics, Sines};
use super::torque_slopes::TorqueSlopes;
use rig::effects::Transmission;
use rig::plant::Body;

/// Equation of motion of a joint at a sample, the other joints moving as measured: its inertia
/// times its acceleration is the torque on it less a bias.
#[derive(Clone, Copy, Debug)]
pub struct JointDynamics {
    pub(crate) inertia_kg_m2: f64,
    /// Torque that it needs without acceleration of its own, at the motor's angle: gravity,
    /// Coriolis, and the accelerations of the other joints.
    pub(crate) bias_nm: f64,
    /// Slopes of that torque along the joint's own angle and velocity: a link is a little
    /// away from its motor, and gravity's slope shifts the resonance.
    along_angle_nm: f64,
    along_velocity_nm_s: f64,
}

impl JointDynamics {
    /// At every sample of a motion; `sines` are those of its angles, for a chain.
    pub fn along(joint: usize, motor: &Kinematics, sines: &[Sines], body: &Body) -> Vec<Self> {
        let slopes = TorqueSlopes::along(joint, motor, sines, body);
        let both = slopes.zip(&motor.qdd_rad_per_s2[joint]);
        both.map(|(slopes, qdd)| Self::of(joint, &slopes, *qdd)).collect()
    }

    /// Neither an own inertia nor its part of the torque changes with the joint's own angle.
    fn of(joint: usize, slopes: &TorqueSlopes, qdd_rad_per_s2: f64) -> Self {
        let inertia_kg_m2 = slopes.inertia_kg_m2[joint];
        Self {
            inertia_kg_m2,
            bias_nm: slopes.here_nm[joint] - inertia_kg_m2 * qdd_rad_per_s2,
            along_angle_nm: slopes.along_angle_nm[joint],
            along_velocity_nm_s: slopes.along_velocity_nm_s[joint],
        }
    }

    /// Without the motor's inertia, which enters nothing but the joint's own.
    pub(crate) fn without_motor(&self, spring: &Transmission) -> Self {
        Self { inertia_kg_m2: self.inertia_kg_m2 - spring.motor_inertia_kg_m2, ..*self }
    }

    /// Part `x` of the way to another sample.
    pub(crate) fn towards(&self, other: &Self, x: f64) -> Self {
        let between = |here: f64, there: f64| here + x * (there - here);
        Self {
            inertia_kg_m2: between(self.inertia_kg_m2, other.inertia_kg_m2),
            bias_nm: between(self.bias_nm, other.bias_nm),
            along_angle_nm: between(self.along_angle_nm, other.along_angle_nm),
            along_velocity_nm_s: between(self.along_velocity_nm_s, other.along_velocity_nm_s),
        }
    }

    /// With the link ahead of its motor by `ahead_rad` and `ahead_rad_per_s`.
    pub(crate) fn with_link_ahead(&self, ahead_rad: f64, ahead_rad_per_s: f64) -> Self {
        let bias_nm = self.bias_nm
            + self.along_angle_nm * ahead_rad
            + self.along_velocity_nm_s * ahead_rad_per_s;
        Self { bias_nm, ..*self }
    }

    /// Acceleration under a torque [rad/s^2].
    pub(crate) fn acceleration(&self, torque_nm: f64) -> f64 {
        (torque_nm - self.bias_nm) / self.inertia_kg_m2
    }
}
