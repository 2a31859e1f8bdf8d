//! Weighted least squares of all numbers.

use nalgebra::DMatrix;

/// What least squares find.
pub struct Linear {
    /// The numbers.
    pub numbers: Vec<f64>,
    /// Their variances, where rows have residuals of variance one.
    pub variances: Vec<f64>,
}

/// Added to squares of columns of length one.
const DAMPING: f64 = 1e-10;

impl Linear {
    /// Of weighted rows with their command as last column, with as little damping as rounding asks, columns scaled to
    /// one.
    pub fn of(rows: &DMatrix<f64>) -> Option<Self> {
        let count = rows.ncols() - 1;
        let scale: Vec<f64> = (0..count).map(|k| rows.column(k).norm().max(1e-300)).collect();
        let mut columns = rows.columns(0, count).into_owned();
        for (mut column, scale) in columns.column_iter_mut().zip(&scale) {
            column /= *scale;
        }
        let mut gram = columns.tr_mul(&columns);
        (0..count).for_each(|k| gram[(k, k)] += DAMPING);
        let factors = gram.cholesky()?;
        let found = factors.solve(&columns.tr_mul(&rows.column(count)));
        let variances = factors.inverse().diagonal();
        Some(Self {
            numbers: found.iter().zip(&scale).map(|(x, scale)| x / scale).collect(),
            variances: variances
                .iter()
                .zip(&scale)
                .map(|(x, scale)| open(*x) / (scale * scale))
                .collect(),
        })
    }
}

/// The variance of a scaled number; infinite where damping alone bounds it, in columns that are sums of others.
fn open(variance: f64) -> f64 {
    if variance > 0.01 / DAMPING { f64::INFINITY } else { variance }
}
