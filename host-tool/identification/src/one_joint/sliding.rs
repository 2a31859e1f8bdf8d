//! Sliding friction and linear terms by linear least squares, where friction is Coulomb's.

use nalgebra::{DMatrix, DVector};

use super::rows::Rows;

/// Parameters of the rows in clear sliding.
#[derive(Clone, Debug)]
pub struct Sliding {
    /// Coulomb level [V].
    pub alpha0_v: f64,
    /// Viscous coefficient [V s/rad].
    pub alpha2_v_s_per_rad: f64,
    /// Factors of the rows' linear terms.
    pub factors: DVector<f64>,
}

/// Fits alpha_0 sign(v) + alpha_2 v and the linear terms where the joint slides clearly.
///
/// `None` where it never does both ways.
pub fn sliding(rows: &Rows) -> Option<Sliding> {
    let clear = clearly_sliding(rows);
    let both = |sign: f64| clear.iter().any(|&r| rows.motion[r].qd_rad_per_s * sign > 0.0);
    if clear.len() < 20 || !both(1.0) || !both(-1.0) {
        return None;
    }
    let width = 2 + rows.data.columns.ncols();
    let regressors = DMatrix::from_fn(clear.len(), width, |i, column| {
        let velocity = rows.motion[clear[i]].qd_rad_per_s;
        match column {
            0 => velocity.signum(),
            1 => velocity,
            _ => rows.data.columns[(clear[i], column - 2)],
        }
    });
    let command = DVector::from_fn(clear.len(), |i, _| rows.data.command_v[clear[i]]);
    let solution = regressors.svd(true, true).solve(&command, 1e-9).ok()?;
    Some(Sliding {
        alpha0_v: solution[0].max(1e-3),
        alpha2_v_s_per_rad: solution[1].max(1e-4),
        factors: solution.rows_range(2..).into_owned(),
    })
}

/// Rows far faster than any Stribeck velocity and past the bristles' travel.
pub fn clearly_sliding(rows: &Rows) -> Vec<usize> {
    const SPEED_RAD_PER_S: f64 = 0.02;
    const TRAVEL_RAD: f64 = 0.01;
    let mut since_reversal_rad = 0.0;
    let mut last = 0.0f64;
    let row_s = rows.data.step_s * rows.data.points_per_row as f64;
    let mut clear = Vec::new();
    for (index, row) in rows.motion.iter().enumerate() {
        let velocity = row.qd_rad_per_s;
        if velocity * last <= 0.0 {
            since_reversal_rad = 0.0;
        }
        since_reversal_rad += velocity.abs() * row_s;
        last = velocity;
        let counts = rows.data.weight[index] > 0.0;
        if counts && velocity.abs() > SPEED_RAD_PER_S && since_reversal_rad > TRAVEL_RAD {
            clear.push(index);
        }
    }
    clear
}
