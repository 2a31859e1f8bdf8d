//! The state of all joints and its steps by the midpoint leapfrog.

/// Positions, velocities and accelerations of all joints.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    pub q_rad: Vec<f64>,
    pub qd_rad_per_s: Vec<f64>,
    pub qdd_rad_per_s2: Vec<f64>,
}

impl Motion {
    pub(super) fn at_rest(q_rad: &[f64]) -> Self {
        let none = vec![0.0; q_rad.len()];
        Self { q_rad: q_rad.to_vec(), qd_rad_per_s: none.clone(), qdd_rad_per_s2: none }
    }

    /// Takes over another motion of as many joints.
    pub(super) fn copy_from(&mut self, other: &Self) {
        self.q_rad.copy_from_slice(&other.q_rad);
        self.qd_rad_per_s.copy_from_slice(&other.qd_rad_per_s);
        self.qdd_rad_per_s2.copy_from_slice(&other.qdd_rad_per_s2);
    }

    /// Moves the positions on by half a step, and tells the velocities expected there.
    pub(super) fn drift_to_midpoint(&mut self, half_s: f64, middle: &mut [f64]) {
        for i in 0..self.q_rad.len() {
            self.q_rad[i] += half_s * self.qd_rad_per_s[i];
            middle[i] = self.qd_rad_per_s[i] + half_s * self.qdd_rad_per_s2[i];
        }
    }

    /// Takes the accelerations of the middle and moves on to the end of the step.
    pub(super) fn kick_and_drift(&mut self, qdd_rad_per_s2: &[f64], half_s: f64) {
        for i in 0..self.q_rad.len() {
            self.qd_rad_per_s[i] += 2.0 * half_s * qdd_rad_per_s2[i];
            self.q_rad[i] += half_s * self.qd_rad_per_s[i];
        }
        self.qdd_rad_per_s2.copy_from_slice(qdd_rad_per_s2);
    }
}
