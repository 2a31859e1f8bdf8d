//! Linear least squares, eq. (13)-(16), weighted, with covariance.

use nalgebra::{DMatrix, DVector};

/// An overdetermined system: rows times parameters = right-hand side.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearProblem {
    /// Phi of eq. (14), a row per equation.
    pub rows: DMatrix<f64>,
    /// y of eq. (15).
    pub right: DVector<f64>,
}

/// Solution of a [`LinearProblem`].
#[derive(Clone, Debug, PartialEq)]
pub struct LinearFit {
    /// The parameters p of eq. (16).
    pub parameters: DVector<f64>,
    /// Their covariance for white residuals, scaled with the residuals' variance.
    pub covariance: DMatrix<f64>,
    /// (rows^T rows)^-1, the covariance for residuals of variance one.
    pub unit_covariance: DMatrix<f64>,
    /// Right-hand side less rows times parameters.
    pub residuals: DVector<f64>,
    /// Largest over smallest singular value of the rows, the paper's J_k.
    pub condition_number: f64,
}

impl LinearProblem {
    /// The same system with every equation multiplied by the root of its weight.
    pub fn weighted(mut self, weight: &[f64]) -> Self {
        for (index, weight) in weight.iter().enumerate() {
            let root = weight.sqrt();
            self.rows.row_mut(index).scale_mut(root);
            self.right[index] *= root;
        }
        self
    }

    /// Solves it; `None` where the rows do not determine all parameters.
    pub fn solve(&self) -> Option<LinearFit> {
        let count = self.rows.ncols();
        let factor = self.triangular_factor()?;
        let singular = factor.clone().svd(false, false).singular_values;
        let (largest, smallest) = (singular.max(), singular.min());
        if smallest.is_nan() || smallest <= largest * 1e-13 {
            return None;
        }
        let inverse = factor.try_inverse()?;
        let unit_covariance = &inverse * inverse.transpose();
        // Corrected once with its own residuals: as exact as an orthogonal solution.
        let first = &unit_covariance * self.rows.tr_mul(&self.right);
        let left_over = &self.right - &self.rows * &first;
        let parameters = first + &unit_covariance * self.rows.tr_mul(&left_over);
        let residuals = &self.right - &self.rows * &parameters;
        let freedom = self.rows.nrows().saturating_sub(count).max(1) as f64;
        let variance = residuals.norm_squared() / freedom;
        Some(LinearFit {
            covariance: &unit_covariance * variance,
            unit_covariance,
            parameters,
            residuals,
            condition_number: largest / smallest,
        })
    }

    /// The parameters and the covariance for residuals of variance one, by normal equations
    /// with columns scaled to one: several times faster than [`Self::solve`], for use in
    /// loops. Half as many digits: `None` where columns are nearly dependent (to 1e-5).
    pub fn solve_fast(&self) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let scale = DVector::from_iterator(
            self.rows.ncols(),
            self.rows.column_iter().map(|column| 1.0 / column.norm()),
        );
        let mut gram = self.rows.tr_mul(&self.rows);
        let mut moment = self.rows.tr_mul(&self.right);
        for k in 0..gram.ncols() {
            gram.row_mut(k).scale_mut(scale[k]);
            gram.column_mut(k).scale_mut(scale[k]);
            moment[k] *= scale[k];
        }
        let factor = gram.cholesky()?;
        let smallest = factor.l_dirty().diagonal().min();
        if smallest.is_nan() || smallest <= 1e-5 {
            return None;
        }
        let parameters = factor.solve(&moment).component_mul(&scale);
        let mut unit = factor.inverse();
        for k in 0..unit.ncols() {
            unit.row_mut(k).scale_mut(scale[k]);
            unit.column_mut(k).scale_mut(scale[k]);
        }
        Some((parameters, unit))
    }

    /// The condition number J_k of the rows; infinite where they do not determine all
    /// parameters.
    pub fn condition_number(&self) -> f64 {
        let Some(factor) = self.triangular_factor() else { return f64::INFINITY };
        let singular = factor.svd(false, false).singular_values;
        singular.max() / singular.min()
    }

    /// R of the rows' QR factorisation, which has their singular values.
    fn triangular_factor(&self) -> Option<DMatrix<f64>> {
        let enough = self.rows.nrows() >= self.rows.ncols() && self.rows.ncols() > 0;
        (enough && self.rows.iter().all(|x| x.is_finite())).then(|| self.rows.clone().qr().r())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// y = 2 + 3 x with alternating errors of 0.1.
    fn line(samples: usize) -> LinearProblem {
        let x = |index: usize| index as f64 / samples as f64;
        let rows = DMatrix::from_fn(samples, 2, |index, column| x(index).powi(column as i32));
        let error = |index: usize| if index.is_multiple_of(2) { 0.1 } else { -0.1 };
        let right = DVector::from_fn(samples, |index, _| 2.0 + 3.0 * x(index) + error(index));
        LinearProblem { rows, right }
    }

    #[test]
    fn a_line_is_found_with_its_errors() {
        let fit = line(1000).solve().unwrap();
        assert!((fit.parameters[0] - 2.0).abs() < 1e-3);
        assert!((fit.parameters[1] - 3.0).abs() < 2e-3);
        // Textbook: variance of the slope = s^2 / sum (x - mean)^2.
        let slope_error = fit.covariance[(1, 1)].sqrt();
        assert!((slope_error - 0.1 / (1000f64 / 12.0).sqrt()).abs() < 1e-4, "{slope_error}");
    }

    #[test]
    fn the_fast_solution_is_the_same() {
        let problem = line(1000);
        let (fit, fast) = (problem.solve().unwrap(), problem.solve_fast().unwrap());
        assert!((fit.parameters - fast.0).amax() < 1e-9);
        assert!((fit.unit_covariance - fast.1).amax() < 1e-9);
        let mut dependent = problem;
        dependent.rows.set_column(1, &DVector::from_element(1000, 1.0));
        assert_eq!(dependent.solve_fast(), None);
    }

    #[test]
    fn weights_silence_equations() {
        let mut problem = line(100);
        problem.right[7] = 1e3;
        let weight: Vec<f64> = (0..100).map(|index| if index == 7 { 0.0 } else { 1.0 }).collect();
        let fit = problem.weighted(&weight).solve().unwrap();
        assert!((fit.parameters[0] - 2.0).abs() < 0.02);
    }

    #[test]
    fn rows_that_do_not_suffice_have_no_solution() {
        let mut problem = line(10);
        problem.rows.set_column(1, &DVector::from_element(10, 1.0));
        assert_eq!(problem.solve(), None);
        assert!(problem.condition_number() > 1e13);
        problem.rows[(3, 0)] = f64::NAN;
        assert_eq!(problem.solve(), None);
        assert_eq!(problem.condition_number(), f64::INFINITY);
    }

    #[test]
    fn the_condition_number_is_the_ratio_of_singular_values() {
        let rows = DMatrix::from_diagonal(&DVector::from_vec(vec![1.0, 4.0, 8.0]));
        let problem = LinearProblem { rows, right: DVector::zeros(3) };
        assert!((problem.condition_number() - 8.0).abs() < 1e-12);
    }
}
