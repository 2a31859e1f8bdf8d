//! The regressor R of eq. (5): torques are linear in the base parameters.

use crate::base::COUNT;
use crate::vector::Vector3;
use crate::{BaseParameters, Geometry, Posture, Real};

/// R(q, qd, qdd), one row of 16 per joint: tau = R p, p in the order of [`crate::base::NAMES`].
///
/// Column k is the inverse dynamics of a robot whose only parameter is the k-th,
/// one: the closed form stands in one place, and eq. (5) holds by construction.
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
pub fn regressor<T: Real>(
    posture: &Posture<T>,
    geometry: &Geometry<T>,
    qd_rad_per_s: &Vector3<T>,
    qdd_rad_per_s2: &Vector3<T>,
) -> [[T; COUNT]; 3] {
    let mut rows = [[T::zero(); COUNT]; 3];
    // Zeros with a one between: read from further left at each column, the one moves on
    // from parameter to parameter. Neighbouring columns read neighbouring entries, so
    // that the compiler computes two (f64) or four (f32) columns at once.
    let mut one_among_zeros = [T::zero(); 2 * COUNT - 1];
    one_among_zeros[COUNT - 1] = T::one();
    for column in 0..COUNT {
        let unit = core::array::from_fn(|k| one_among_zeros[COUNT - 1 + column - k]);
        let p = BaseParameters::from_array(unit);
        let torque = posture.inverse_dynamics(&p, geometry, qd_rad_per_s, qdd_rad_per_s2);
        for (row, value) in rows.iter_mut().zip(torque) {
            row[column] = value;
        }
    }
    rows
}
