//! Phi of eq. (14) and its condition number J_k.

use model::base::COUNT;
use model::regressor::regressor;
use model::{Geometry, Posture};
use nalgebra::{DMatrix, SMatrix};

use super::series::State;

/// Phi of eq. (14) [V per parameter]: k_t^-1 R of every state, three rows each.
pub fn stacked_regressor(
    geometry: &Geometry<f64>,
    torque_constant_nm_per_v: &[f64; 3],
    states: impl Iterator<Item = State>,
) -> DMatrix<f64> {
    let mut entries = Vec::with_capacity(states.size_hint().0 * 3 * COUNT);
    for state in states {
        let posture = Posture::new(state.q_rad[1], state.q_rad[2]);
        let rows = regressor(&posture, geometry, &state.qd_rad_per_s, &state.qdd_rad_per_s2);
        for (row, k_t) in rows.iter().zip(torque_constant_nm_per_v) {
            entries.extend(row.iter().map(|torque_nm| torque_nm / k_t));
        }
    }
    // Rows lie one after another: as columns of the transpose.
    DMatrix::from_vec(COUNT, entries.len() / COUNT, entries).transpose()
}

/// J_k, the ratio of the largest to the smallest singular value of Phi, section 4.1.
///
/// Infinite where the columns are linearly dependent.
pub fn condition_number(phi: &DMatrix<f64>) -> f64 {
    // The singular values are the roots of Gram's eigenvalues: at a J_k below 1e6
    // squaring costs no digit that matters, and 16 x 16 is soon done.
    let gram: SMatrix<f64, COUNT, COUNT> = phi.tr_mul(phi).fixed_view::<COUNT, COUNT>(0, 0).into();
    let eigenvalues = gram.symmetric_eigenvalues();
    let (smallest, largest) = (eigenvalues.min(), eigenvalues.max());
    if smallest > 1e-12 * largest { (largest / smallest).sqrt() } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use model::reference_robot::reference_robot;

    use super::*;

    fn phi(states: impl Iterator<Item = State>) -> DMatrix<f64> {
        let robot = reference_robot::<f64>();
        stacked_regressor(&robot.geometry, &robot.torque_constant_nm_per_v, states)
    }

    fn lively(count: usize) -> impl Iterator<Item = State> {
        (0..count).map(|k| {
            let wave = |rate: f64| (rate * k as f64).sin();
            State {
                q_rad: [0.0, 6.0 * wave(0.7), 6.0 * wave(1.3)],
                qd_rad_per_s: [5.0 * wave(0.9), 8.0 * wave(1.1), 8.0 * wave(1.7)],
                qdd_rad_per_s2: [12.0 * wave(2.1), 20.0 * wave(0.3), 20.0 * wave(2.9)],
            }
        })
    }

    #[test]
    fn it_is_the_ratio_of_singular_values() {
        let phi = phi(lively(500));
        let values = phi.clone().svd(false, false).singular_values;
        let expected = values.max() / values.min();
        assert!((condition_number(&phi) / expected - 1.0).abs() < 1e-9, "{expected}");
    }

    #[test]
    fn rows_give_the_voltages() {
        let robot = reference_robot::<f64>();
        let state = lively(7).last().unwrap();
        let torque_nm = Posture::new(state.q_rad[1], state.q_rad[2]).inverse_dynamics(
            &robot.base,
            &robot.geometry,
            &state.qd_rad_per_s,
            &state.qdd_rad_per_s2,
        );
        let p = nalgebra::DVector::from_row_slice(&robot.base.to_array());
        let voltage_v = phi(std::iter::once(state)) * p;
        for (found, expected) in voltage_v.iter().zip(robot.torque_to_voltage(&torque_nm)) {
            assert!((found - expected).abs() < 1e-12);
        }
    }

    #[test]
    fn a_joint_at_rest_leaves_parameters_unseen() {
        let still = lively(100).map(|state| State { qdd_rad_per_s2: [0.0; 3], ..state });
        let still = still.map(|state| State { qd_rad_per_s: [0.0; 3], ..state });
        assert_eq!(condition_number(&phi(still)), f64::INFINITY);
    }
}
