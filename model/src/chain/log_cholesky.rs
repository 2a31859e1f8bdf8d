//! Bodies by ten numbers that may be anything (Rucker and Wensing, *Smooth parameterization of
//! rigid-body inertia*, IEEE Robotics and Automation Letters 7, 2022).
//!
//! The pseudo-inertia J = [[S, m c], [m c^T, m]], S the second moments of mass, is U U^T with
//! U = e^a [[e^d1, s12, s13, c1], [0, e^d2, s23, c2], [0, 0, e^d3, c3], [0, 0, 0, 1]]: positive
//! definite whatever the numbers are, so that a search over them never leaves what matter can be.

use super::body::{BODY_PARAMETERS, Body};
use crate::Real;
use crate::vector::Vector3;

impl<T: Real> Body<T> {
    /// The body of a, d1, d2, d3, s12, s23, s13, c1, c2, c3: mass e^(2 a) kg, centre c [m], the
    /// others logarithms of and lengths in metres.
    pub fn of_log_cholesky(numbers: &[T; BODY_PARAMETERS]) -> Self {
        let [a, d1, d2, d3, s12, s23, s13, x, y, z] = *numbers;
        let [u1, u2, u3] = [d1, d2, d3].map(Real::exp);
        let mass = (a + a).exp();
        let [xx, yy, zz] = [u1 * u1 + s12 * s12 + s13 * s13, u2 * u2 + s23 * s23, u3 * u3];
        let [xy, xz, yz] = [u2 * s12 + s13 * s23, u3 * s13, u3 * s23];
        let inertia = [yy + zz, -xy, -xz, xx + zz, -yz, xx + yy].map(|entry| mass * entry);
        Self::about_centre(mass, [x, y, z], inertia)
    }
}

impl Body<f64> {
    /// The numbers of [`Body::of_log_cholesky`]; `None` where no matter can be so.
    pub fn log_cholesky(&self) -> Option<[f64; BODY_PARAMETERS]> {
        if !self.is_physical() {
            return None;
        }
        let mass = self.mass_kg;
        let [x, y, z]: Vector3<f64> = self.moment_kg_m.map(|moment| moment / mass);
        let at = Body::point(mass, [x, y, z]).inertia_kg_m2;
        let [ixx, ixy, ixz, iyy, iyz, izz]: [f64; 6] =
            core::array::from_fn(|k| (self.inertia_kg_m2[k] - at[k]) / mass);
        let half = (ixx + iyy + izz) / 2.0;
        let [xx, yy, zz] = [half - ixx, half - iyy, half - izz];
        let u3 = libm::sqrt(zz);
        let (s13, s23) = (-ixz / u3, -iyz / u3);
        let u2 = libm::sqrt(yy - s23 * s23);
        let s12 = (-ixy - s13 * s23) / u2;
        let u1 = libm::sqrt(xx - s12 * s12 - s13 * s13);
        let [a, d1, d2, d3] = [libm::sqrt(mass), u1, u2, u3].map(libm::log);
        let numbers = [a, d1, d2, d3, s12, s23, s13, x, y, z];
        numbers.iter().all(|number| number.is_finite()).then_some(numbers)
    }
}
