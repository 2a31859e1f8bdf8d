//! The regressor R of eq. (5): torques are linear in the base parameters.

use crate::base::COUNT;
use crate::vector::Vector3;
use crate::{Geometry, Posture, Real};

/// R(q, qd, qdd), one row of 16 per joint: tau = R p, p in the order of [`crate::base::NAMES`].
///
/// In closed form: each column is what [`Posture::inverse_dynamics`] leaves of MODEL.md's D, of its
/// Christoffel symbols and of h where the other 15 parameters are zero, which a test holds it to.
///
/// ```
/// use model::{Posture, reference_robot::reference_robot, regressor::regressor};
///
/// let model::Robot { base, geometry, .. } = reference_robot::<f64>();
/// let posture = Posture::new(0.3, -0.5); // q2, q3 [rad]
/// let (qd, qdd) = ([0.0, 1.0, 0.5], [0.0, 0.0, 2.0]); // [rad/s], [rad/s^2]
///
/// let rows = regressor(&posture, &geometry, &qd, &qdd);
/// let torque_nm = posture.inverse_dynamics(&base, &geometry, &qd, &qdd);
/// let product = |joint: usize| -> f64 {
///     rows[joint].iter().zip(base.to_array()).map(|(r, p)| r * p).sum()
/// };
/// assert!((product(1) - torque_nm[1]).abs() < 1e-12);
/// ```
#[inline]
pub fn regressor<T: Real>(
    posture: &Posture<T>,
    geometry: &Geometry<T>,
    qd_rad_per_s: &Vector3<T>,
    qdd_rad_per_s2: &Vector3<T>,
) -> [[T; COUNT]; 3] {
    let zero = T::zero();
    let Posture { s2, c2, s3, c3, s23, c23 } = *posture;
    let (g, [qd1, qd2, qd3], [a1, a2, a3]) =
        (geometry.gravity_m_s2, *qd_rad_per_s, *qdd_rad_per_s2);
    let (qd23, a23) = (qd2 + qd3, a2 + a3);
    let Plate { xx: xx2, xy: xy2 } = plate((s2, c2), qd1, qd2, a1);
    let Plate { xx: xx3, xy: xy3 } = plate((s23, c23), qd1, qd23, a1);
    let [(xz2, yz2), (xz3, yz3)] = [(s2, c2, qd2, a2), (s23, c23, qd23, a23)]
        .map(|(s, c, qd, a)| (s * a + c * qd * qd, c * a - s * qd * qd));
    let elbow = Elbow { s2, c2, length: geometry.a2_m, qd: [qd1, qd2, qd3, qd23] };
    let mx3 = elbow.along((c23, s23), (c3, s3), g * c23, qdd_rad_per_s2);
    // The moment across the link is one along it, a quarter turn further.
    let my3 = elbow.along((-s23, c23), (-s3, c3), -g * s23, qdd_rad_per_s2);
    let ([mx2, my2], [xz, yz]) = ([g * c2, -g * s2], [s23 * a1, c23 * a1]);
    // zz1r xx2r xy2r xz2r yz2r zz2r mx2r my2r, then xx3r xy3r xz3r yz3r zz3r mx3r my3r ia3.
    [
        joined(
            [a1, xx2[0], xy2[0], xz2, yz2, zero, zero, zero],
            [xx3[0], xy3[0], xz3, yz3, zero, mx3[0], my3[0], zero],
        ),
        joined(
            [zero, xx2[1], xy2[1], s2 * a1, c2 * a1, a2, mx2, my2],
            [xx3[1], xy3[1], xz, yz, a23, mx3[1], my3[1], zero],
        ),
        joined([zero; 8], [xx3[1], xy3[1], xz, yz, a23, mx3[2], my3[2], a3]),
    ]
}

/// A row from the columns of links 1 and 2, and of link 3.
#[inline]
fn joined<T: Real>(first: [T; 8], second: [T; 8]) -> [T; COUNT] {
    let mut row = [T::zero(); COUNT];
    row[..8].copy_from_slice(&first);
    row[8..].copy_from_slice(&second);
    row
}

/// Torques of joint 1 and of the joints that tilt a link, by its xx and xy.
struct Plate<T> {
    xx: [T; 2],
    xy: [T; 2],
}

/// D11 = xx s^2 + 2 xy s c of a link at an angle of sine and cosine that turns at `qd`.
#[inline]
fn plate<T: Real>((s, c): (T, T), qd1: T, qd: T, a1: T) -> Plate<T> {
    let (product, difference) = (s * c, c * c - s * s);
    let (twice_sine, square) = (product + product, qd1 * qd1);
    let turning = (qd1 + qd1) * qd;
    Plate {
        xx: [s * s * a1 + product * turning, -product * square],
        xy: [twice_sine * a1 + difference * turning, -difference * square],
    }
}

/// What the forearm's first moment does at the end of the upper arm.
struct Elbow<T> {
    s2: T,
    c2: T,
    /// a2 [m].
    length: T,
    /// qd1, qd2, qd3, qd2 + qd3 [rad/s].
    qd: [T; 4],
}

impl<T: Real> Elbow<T> {
    /// Torques by a first moment whose direction has this cosine and sine to the level, and to the
    /// upper arm; `weight` is what it weighs on joints 2 and 3.
    #[inline]
    fn along(
        &self,
        (forward, up): (T, T),
        (ahead, aside): (T, T),
        weight: T,
        [a1, a2, a3]: &Vector3<T>,
    ) -> Vector3<T> {
        let (Self { s2, c2, length, .. }, [qd1, qd2, qd3, qd23]) = (self, self.qd);
        let square = qd1 * qd1;
        let spin = *c2 * forward * *a1 - qd1 * (*s2 * forward * qd2 + *c2 * up * qd23);
        let carried = ahead * *a2;
        let tilt = carried + carried + ahead * *a3 - aside * qd3 * (qd2 + qd23)
            + (*c2 * up + *s2 * forward) * square;
        let swing = carried + aside * qd2 * qd2 + *c2 * up * square;
        [*length * (spin + spin), *length * tilt + weight, *length * swing + weight]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BaseParameters;
    use crate::reference_robot::reference_robot;

    #[test]
    fn each_column_is_the_torque_of_its_parameter_alone() {
        let geometry = reference_robot::<f64>().geometry;
        for k in 0..200 {
            let at = |i: i32| libm::sin(f64::from(k * 9 + i) * 1.7) * 3.0;
            let posture = Posture::new(at(0), at(1));
            let (qd, qdd) = ([at(2), at(3), at(4)], [at(5), at(6), at(7)].map(|a| 10.0 * a));
            let rows = regressor(&posture, &geometry, &qd, &qdd);
            for column in 0..COUNT {
                let unit = core::array::from_fn(|k| if k == column { 1.0 } else { 0.0 });
                let base = BaseParameters::from_array(unit);
                let torque = posture.inverse_dynamics(&base, &geometry, &qd, &qdd);
                for joint in 0..3 {
                    let error = (rows[joint][column] - torque[joint]).abs();
                    assert!(error <= 1e-12 * torque[joint].abs().max(1.0), "{column} {error:e}");
                }
            }
        }
    }
}
