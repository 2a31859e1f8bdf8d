//! The state of three joints and its steps by the midpoint leapfrog.

use model::vector::Vector3;

/// Positions, velocities and accelerations of three joints.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    pub q_rad: Vector3<f64>,
    pub qd_rad_per_s: Vector3<f64>,
    pub qdd_rad_per_s2: Vector3<f64>,
}

impl Motion {
    pub(super) fn at_rest(q_rad: Vector3<f64>) -> Self {
        Self { q_rad, qd_rad_per_s: [0.0; 3], qdd_rad_per_s2: [0.0; 3] }
    }

    /// Moves the positions on by half a step, returns the velocities expected there.
    pub(super) fn drift_to_midpoint(&mut self, half_s: f64) -> Vector3<f64> {
        for i in 0..3 {
            self.q_rad[i] += half_s * self.qd_rad_per_s[i];
        }
        [0, 1, 2].map(|i| self.qd_rad_per_s[i] + half_s * self.qdd_rad_per_s2[i])
    }

    /// Takes the accelerations of the middle and moves on to the end of the step.
    pub(super) fn kick_and_drift(&mut self, qdd_rad_per_s2: Vector3<f64>, half_s: f64) {
        for i in 0..3 {
            self.qd_rad_per_s[i] += 2.0 * half_s * qdd_rad_per_s2[i];
            self.q_rad[i] += half_s * self.qd_rad_per_s[i];
        }
        self.qdd_rad_per_s2 = qdd_rad_per_s2;
    }
}
