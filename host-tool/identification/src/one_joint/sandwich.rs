//! Standard errors from blocks of data: the jackknife, a sandwich covariance.

use nalgebra::{DMatrix, DVector};

/// Covariance of a least-squares estimate by the jackknife over blocks of rows.
///
/// See [`jackknife`]; H = J'J and g_b = J_b' r_b. Rows of the Jacobian beyond the
/// residual's are those of priors with errors of standard deviation `prior_deviation`:
/// they count in H and add H^-1 J_p' J_p H^-1 times its square.
pub fn covariance(
    jacobian: &DMatrix<f64>,
    residual: &DVector<f64>,
    rows_per_block: usize,
    prior_deviation: f64,
) -> DMatrix<f64> {
    let whole = jacobian.tr_mul(jacobian);
    let rows_per_block = rows_per_block.max(1);
    let blocks = (0..residual.len()).step_by(rows_per_block).map(|begin| {
        let rows = rows_per_block.min(residual.len() - begin);
        let block = jacobian.rows(begin, rows);
        (block.tr_mul(&block), block.tr_mul(&residual.rows(begin, rows)))
    });
    let from_blocks = jackknife(&whole, blocks);
    let priors = jacobian.rows(residual.len(), jacobian.nrows() - residual.len());
    let Some(inverse) = scaled_inverse(&whole, &whole) else { return from_blocks };
    let reach = priors * inverse * prior_deviation;
    from_blocks + reach.tr_mul(&reach)
}

/// Covariance of an estimate that solves sum of scores g_b = 0 with slope matrix H.
///
/// Each block is left out in turn and the estimate moves, to first order, by
/// (H - H_b)^-1 g_b. Residuals may be correlated within a block and differ in size from
/// block to block; a parameter that one block alone determines gets the large error it
/// deserves. (Cameron and Miller, 2015, call this CR3.) Infinite where the blocks
/// cannot determine the estimate.
pub fn jackknife(
    whole: &DMatrix<f64>,
    blocks: impl Iterator<Item = (DMatrix<f64>, DVector<f64>)>,
) -> DMatrix<f64> {
    let size = whole.nrows();
    let mut sum = DMatrix::zeros(size, size);
    let mut count = 0.0;
    for (hessian, score) in blocks {
        if score.iter().all(|&g| g == 0.0) {
            continue;
        }
        let Some(inverse) = scaled_inverse(&(whole - hessian), whole) else {
            return DMatrix::from_diagonal_element(size, size, f64::INFINITY);
        };
        let change = inverse * score;
        sum += &change * change.transpose();
        count += 1.0;
    }
    sum * ((count - 1.0) / f64::max(count, 1.0))
}

/// The inverse of a positive definite matrix, computed with the other's diagonal scaled to one.
pub fn scaled_inverse(matrix: &DMatrix<f64>, scale_of: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let scale: Vec<f64> = scale_of.diagonal().iter().map(|d| 1.0 / d.max(1e-300).sqrt()).collect();
    let size = matrix.nrows();
    let even = DMatrix::from_fn(size, size, |i, j| {
        let ridge = if i == j { 1e-12 } else { 0.0 };
        scale[i] * matrix[(i, j)] * scale[j] + ridge
    });
    let inverse = even.cholesky()?.inverse();
    Some(DMatrix::from_fn(size, size, |i, j| scale[i] * inverse[(i, j)] * scale[j]))
}
