//! The robot, linearised about a posture of rest.
//!
//! Joints that a log does not show stand still: their rows are those of the identity.

use std::f64::consts::TAU;

use model::vector::Matrix3;
use model::{BaseParameters, Geometry, Posture};
use nalgebra::{Complex, Matrix3 as Square};

/// What does not depend on the frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearRobot {
    /// Which joints move.
    pub present: [bool; 3],
    /// Mass matrix D in the posture [kg m^2].
    pub mass_kg_m2: Matrix3<f64>,
    /// Gravity stiffness dh_i/dq_j in the posture [Nm/rad].
    pub gravity_nm_per_rad: Matrix3<f64>,
    /// Torque constants [Nm/V].
    pub torque_constant_nm_per_v: [f64; 3],
    /// Friction of each joint.
    pub friction: [LinearFriction; 3],
    /// Delay from command to torque beyond the zero-order hold [s].
    pub delay_s: f64,
}

/// LuGre friction, linearised statistically.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearFriction {
    /// Stiffness sigma_0 [V/rad].
    pub sigma0_v_per_rad: f64,
    /// Damping sigma_1 [V s/rad].
    pub sigma1_v_s_per_rad: f64,
    /// Viscous coefficient alpha_2 [V s/rad].
    pub alpha2_v_s_per_rad: f64,
    /// Creep rate lambda of the bristles under noise [1/s].
    pub creep_per_s: f64,
    /// Share kappa of the bristles' motion that a drift under load takes away.
    pub drift_share: f64,
}

impl LinearFriction {
    /// Voltage per angle [V/rad] at the Laplace variable s.
    pub fn impedance(&self, s: Complex<f64>) -> Complex<f64> {
        (s * self.sigma1_v_s_per_rad + self.sigma0_v_per_rad) * self.bristles(s)
            + s * self.alpha2_v_s_per_rad
    }

    /// Bristle deflection over angle, (1 - kappa) s / (s + lambda).
    pub fn bristles(&self, s: Complex<f64>) -> Complex<f64> {
        let follow = 1.0 - self.drift_share;
        if self.creep_per_s > 0.0 {
            s / (s + self.creep_per_s) * follow
        } else {
            Complex::from(follow)
        }
    }

    /// Derivative of [`Self::impedance`] by the logarithm of the creep rate.
    pub fn impedance_by_log_creep(&self, s: Complex<f64>) -> Complex<f64> {
        let stiff = (s * self.sigma1_v_s_per_rad + self.sigma0_v_per_rad) * self.bristles(s);
        -stiff * self.creep_per_s / (s + self.creep_per_s)
    }
}

impl LinearRobot {
    /// The matrix M(s) from angles to voltages [V/rad].
    pub fn matrix(&self, s: Complex<f64>) -> Square<Complex<f64>> {
        Square::from_fn(|i, j| match (self.present[i] && self.present[j], i == j) {
            (false, diagonal) => Complex::from(f64::from(u8::from(diagonal))),
            (true, false) => self.rigid(i, j, s),
            (true, true) => self.rigid(i, i, s) + self.friction[i].impedance(s),
        })
    }

    fn rigid(&self, i: usize, j: usize, s: Complex<f64>) -> Complex<f64> {
        (s * s * self.mass_kg_m2[i][j] + self.gravity_nm_per_rad[i][j])
            / self.torque_constant_nm_per_v[i]
    }

    /// The FRF matrix from commands to sampled angles [rad/V] at a frequency [Hz].
    ///
    /// `None` where M is singular.
    pub fn frf(&self, frequency_hz: f64, period_s: f64) -> Option<Square<Complex<f64>>> {
        let s = Complex::new(0.0, TAU * frequency_hz);
        let hold = hold(frequency_hz, period_s) * (-s * self.delay_s).exp();
        Some(self.matrix(s).try_inverse()? * hold)
    }
}

/// Mass matrix and gravity stiffness of the three joints at angles [rad].
pub fn rigid_at(
    base: &BaseParameters<f64>,
    geometry: &Geometry<f64>,
    q_rad: [f64; 3],
) -> (Matrix3<f64>, Matrix3<f64>) {
    const STEP_RAD: f64 = 1e-5;
    let gravity = |q2: f64, q3: f64| Posture::new(q2, q3).gravity(base, geometry);
    let [_, q2, q3] = q_rad;
    let slope = |ahead: [f64; 3], behind: [f64; 3]| {
        [0, 1, 2].map(|i| (ahead[i] - behind[i]) / (2.0 * STEP_RAD))
    };
    let by_q2 = slope(gravity(q2 + STEP_RAD, q3), gravity(q2 - STEP_RAD, q3));
    let by_q3 = slope(gravity(q2, q3 + STEP_RAD), gravity(q2, q3 - STEP_RAD));
    let mass = Posture::new(q2, q3).mass_matrix(base, geometry);
    (mass, [0, 1, 2].map(|i| [0.0, by_q2[i], by_q3[i]]))
}

/// Zero-order hold and sampling of an inertia, over the inertia's own FRF.
///
/// The half sample of the hold, and its images that sampling folds back; they matter
/// only where inertia governs the motion, so that the exact answer for a double
/// integrator holds: (x / sin x)^2 cos x exp(-i x) with x = pi f T.
pub fn hold(frequency_hz: f64, period_s: f64) -> Complex<f64> {
    let x = 0.5 * TAU * frequency_hz * period_s;
    if x.abs() < 1e-9 {
        return Complex::from(1.0);
    }
    Complex::from_polar((x / x.sin()).powi(2) * x.cos(), -x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::reference_robot::reference_robot;

    #[test]
    fn the_hold_is_half_a_sample_late_and_exact_for_an_inertia() {
        let (frequency_hz, period_s) = (150.0, 1e-3);
        let z = Complex::from_polar(1.0, TAU * frequency_hz * period_s);
        let sampled = (z + 1.0) / (z - 1.0).powi(2) * (0.5 * period_s * period_s);
        let continuous = -1.0 / (TAU * frequency_hz).powi(2);
        assert!((hold(frequency_hz, period_s) - sampled / continuous).norm() < 1e-12);
        let late_s = -hold(10.0, period_s).arg() / (TAU * 10.0);
        assert!((late_s - 0.5e-3).abs() < 1e-9);
    }

    #[test]
    fn gravity_holds_the_hanging_arm_like_a_spring() {
        let robot = reference_robot::<f64>();
        let hanging = [0.0, -std::f64::consts::FRAC_PI_2, 0.0];
        let (mass, gravity) = rigid_at(&robot.base, &robot.geometry, hanging);
        let weight = robot.geometry.gravity_m_s2;
        assert!((gravity[2][2] - weight * robot.base.mx3r).abs() < 1e-6);
        assert!((gravity[1][1] - weight * (robot.base.mx3r + robot.base.mx2r)).abs() < 1e-6);
        assert_eq!(gravity[0], [0.0; 3]);
        assert!(mass[0][1].abs() > 0.3, "joint 1 shakes joint 2");
    }

    #[test]
    fn joints_that_are_absent_stand_still() {
        let friction = LinearFriction {
            sigma0_v_per_rad: 200.0,
            sigma1_v_s_per_rad: 2.0,
            ..LinearFriction::default()
        };
        let robot = LinearRobot {
            present: [false, false, true],
            mass_kg_m2: [[1.0; 3]; 3],
            gravity_nm_per_rad: [[5.0; 3]; 3],
            torque_constant_nm_per_v: [2.0; 3],
            friction: [friction; 3],
            delay_s: 0.0,
        };
        let frf = robot.frf(0.0, 1e-3).unwrap();
        assert!((frf[(2, 2)].re - 1.0 / 202.5).abs() < 1e-12);
    }
}
