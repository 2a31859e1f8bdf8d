//! How far a link behind a spring may be from where a model sees it.

use nalgebra::{Matrix2, RowVector2, Vector2};

/// The covariance of a link's angle and velocity, as an extended Kalman filter carries it: in
/// units of the variance of the measured torque, whose size thus need not be known.
#[derive(Clone, Copy, Debug)]
pub struct LinkCovariance {
    covariance: Matrix2<f64>,
    /// Slopes of the state along the state at the begin of the interval.
    transition: Matrix2<f64>,
    /// Slopes, along the same, of the mean torque about the sample at the begin, and of the
    /// interval's part in that about the next.
    early: RowVector2<f64>,
    late: RowVector2<f64>,
    /// Deviation of the torque on a link that no model tells.
    unknown_torque: f64,
}

impl LinkCovariance {
    /// At the begin of a motion, where a torque of a few units may bend the spring.
    pub fn initial(stiffness_nm_per_rad: f64, unknown_torque: f64) -> Self {
        let angle = (3.0 / stiffness_nm_per_rad).powi(2);
        Self {
            covariance: Matrix2::new(angle, 0.0, 0.0, 1e3 * angle),
            transition: Matrix2::identity(),
            early: RowVector2::zeros(),
            late: RowVector2::zeros(),
            unknown_torque,
        }
    }

    /// Goes along with one step of a link: half a step of drift, a kick, half a step of drift.
    /// `slope` are those of the torque's part in the interval's mean along angle and velocity,
    /// `kick` is what such a part adds to the velocity, `x` the place in the interval.
    pub fn advance(&mut self, slope: RowVector2<f64>, kick: f64, step_s: f64, x: f64) {
        self.drift(0.5 * step_s);
        let torque = slope * self.transition;
        self.early += (1.0 - x) * torque;
        self.late += x * torque;
        self.transition[(1, 0)] += kick * torque[0];
        self.transition[(1, 1)] += kick * torque[1];
        self.drift(0.5 * step_s);
    }

    fn drift(&mut self, time_s: f64) {
        self.transition[(0, 0)] += time_s * self.transition[(1, 0)];
        self.transition[(0, 1)] += time_s * self.transition[(1, 1)];
    }

    /// Ends an interval with the filter's correction: the change of angle and velocity once the
    /// measured mean torque about the sample at its begin is larger by the innovation. `kick` is
    /// what a torque adds to the velocity over the interval.
    pub fn update(&mut self, innovation_nm: f64, kick: f64) -> Vector2<f64> {
        let back = self.transition.try_inverse().unwrap_or_else(Matrix2::identity);
        self.covariance = self.transition * self.covariance * self.transition.transpose();
        self.covariance[(1, 1)] += (self.unknown_torque * kick).powi(2);
        let slope = self.early * back;
        let across = self.covariance * slope.transpose();
        let gain = across / (1.0 + (slope * across)[0]);
        self.covariance -= gain * across.transpose();
        self.early = self.late * back;
        self.late = RowVector2::zeros();
        self.transition = Matrix2::identity();
        gain * innovation_nm
    }
}
