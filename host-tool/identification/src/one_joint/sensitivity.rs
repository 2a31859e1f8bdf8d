//! Derivatives of the filtered state by the parameters, carried along with the filter.

use super::dynamics::{MAX_PARAMETERS, Step};

/// d(q, qd, z) / d parameters.
pub struct Sensitivity {
    count: usize,
    derivatives: [[f64; MAX_PARAMETERS]; 3],
}

impl Sensitivity {
    /// Of a state that does not depend on its `count` parameters yet.
    pub fn new(count: usize) -> Self {
        Self { count, derivatives: [[0.0; MAX_PARAMETERS]; 3] }
    }

    /// Over a step: S = dx/dp + F S.
    pub fn predict(&mut self, step: &Step) {
        let old = self.derivatives;
        for i in 0..3 {
            for m in 0..self.count {
                self.derivatives[i][m] = step.by_parameter[i][m]
                    + step.by_state[i][0] * old[0][m]
                    + step.by_state[i][1] * old[1][m]
                    + step.by_state[i][2] * old[2][m];
            }
        }
    }

    /// Over a measurement update, the gain taken as constant: S - K H S.
    pub fn update(&mut self, gain: [f64; 3]) {
        let angle = self.derivatives[0];
        for i in 0..3 {
            for m in 0..self.count {
                self.derivatives[i][m] -= gain[i] * angle[m];
            }
        }
    }

    /// Derivatives of the angle.
    pub fn of_angle(&self) -> &[f64] {
        &self.derivatives[0][..self.count]
    }
}
