//! Nonlinear least squares: Levenberg-Marquardt with Jacobians by differences.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};
use rayon::prelude::*;

/// How a nonlinear problem is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NonlinearSettings {
    /// Stops when the sum of squares or the parameters change by less than this, relatively.
    pub tolerance: f64,
    /// Most evaluations of the residuals, in multiples of parameters + 1, Jacobians apart.
    pub patience: usize,
    /// Step of the differences, relative to each parameter's scale.
    pub relative_step: f64,
}

impl Default for NonlinearSettings {
    fn default() -> Self {
        Self { tolerance: 1e-10, patience: 20, relative_step: 1e-5 }
    }
}

/// Solution of a nonlinear problem.
#[derive(Clone, Debug, PartialEq)]
pub struct NonlinearFit {
    /// The parameters.
    pub parameters: Vec<f64>,
    /// Their covariance for white residuals, scaled with the residuals' variance; `None`
    /// where the residuals do not determine all parameters.
    pub covariance: Option<DMatrix<f64>>,
    /// (J^T J)^-1, the covariance for residuals of variance one; `None` likewise.
    pub unit_covariance: Option<DMatrix<f64>>,
    /// Jacobian of the residuals at the solution.
    pub jacobian: DMatrix<f64>,
    /// Residuals at the solution.
    pub residuals: DVector<f64>,
    /// Whether a tolerance was met.
    pub converged: bool,
    /// Evaluations of the residuals, Jacobians apart.
    pub evaluations: usize,
}

/// Minimises the sum of squares of `residuals` from `start`.
///
/// `scale` is each parameter's order of magnitude: steps of the differences are
/// `settings.relative_step` of it. The Jacobian's columns are central differences and
/// computed in parallel. `residuals` returns `None` outside of its domain, where the
/// search then turns back. Returns `None` where the start is outside of the domain, or
/// where there are fewer residuals than parameters.
pub fn minimise(
    residuals: impl Fn(&[f64]) -> Option<Vec<f64>> + Sync,
    start: &[f64],
    scale: &[f64],
    settings: &NonlinearSettings,
) -> Option<NonlinearFit> {
    let problem = Problem::new(&residuals, start, scale, settings.relative_step);
    let count = problem.value.as_ref()?.len();
    if count < start.len() {
        return None;
    }
    let (problem, report) = LevenbergMarquardt::new()
        .with_tol(settings.tolerance)
        .with_patience(settings.patience)
        .minimize(problem);
    let value = problem.value.clone()?;
    let jacobian = problem.jacobian()?;
    let unit_covariance = unit_covariance(&jacobian);
    let variance = value.norm_squared() / (count - start.len()).max(1) as f64;
    Some(NonlinearFit {
        parameters: problem.x.as_slice().to_vec(),
        covariance: unit_covariance.as_ref().map(|unit| unit * variance),
        unit_covariance,
        jacobian,
        residuals: value,
        converged: report.termination.was_successful(),
        evaluations: report.number_of_evaluations,
    })
}

/// (J^T J)^-1 with columns scaled to one, so that units do not matter; `None` where J
/// lacks a rank.
pub fn unit_covariance(jacobian: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let norms: Vec<f64> = jacobian.column_iter().map(|column| column.norm()).collect();
    if !norms.iter().all(|&norm| norm > 0.0 && norm.is_finite()) {
        return None;
    }
    let mut scaled = jacobian.clone();
    for (mut column, norm) in scaled.column_iter_mut().zip(&norms) {
        column /= *norm;
    }
    let factor = scaled.qr().r();
    let diagonal = factor.diagonal().abs();
    if diagonal.min() < 1e-10 * diagonal.max() {
        return None;
    }
    let mut inverse = factor.try_inverse()?;
    for (mut row, norm) in inverse.row_iter_mut().zip(&norms) {
        row /= *norm;
    }
    Some(&inverse * inverse.transpose())
}

/// A problem at one point, in the form that the search asks for.
struct Problem<'a, F> {
    residuals: &'a F,
    step: Vec<f64>,
    x: DVector<f64>,
    value: Option<DVector<f64>>,
}

impl<'a, F: Fn(&[f64]) -> Option<Vec<f64>> + Sync> Problem<'a, F> {
    fn new(residuals: &'a F, start: &[f64], scale: &[f64], relative_step: f64) -> Self {
        let step = scale.iter().map(|scale| scale.abs() * relative_step).collect();
        let x = DVector::from_column_slice(start);
        let value = residuals(start).map(DVector::from_vec);
        Self { residuals, step, x, value }
    }

    /// The derivative of the residuals by a parameter: central, or one-sided at the edge
    /// of the domain.
    fn column(&self, index: usize) -> Option<DVector<f64>> {
        let at = |sign: f64| {
            let mut x = self.x.clone();
            x[index] += sign * self.step[index];
            (self.residuals)(x.as_slice()).map(DVector::from_vec)
        };
        let step = self.step[index];
        match (at(1.0), at(-1.0)) {
            (Some(above), Some(below)) => Some((above - below) / (2.0 * step)),
            (Some(above), None) => Some((above - self.value.as_ref()?) / step),
            (None, Some(below)) => Some((self.value.as_ref()? - below) / step),
            (None, None) => None,
        }
    }
}

impl<F: Fn(&[f64]) -> Option<Vec<f64>> + Sync> LeastSquaresProblem<f64, Dyn, Dyn>
    for Problem<'_, F>
{
    type ParameterStorage = Owned<f64, Dyn>;
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        self.x.copy_from(x);
        self.value = (self.residuals)(x.as_slice()).map(DVector::from_vec);
    }

    fn params(&self) -> DVector<f64> {
        self.x.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        // The search has no word for "outside": infinity is worse than anything.
        let outside = || Some(DVector::from_element(self.step.len(), f64::INFINITY));
        self.value.clone().or_else(outside)
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let columns: Option<Vec<DVector<f64>>> =
            (0..self.x.len()).into_par_iter().map(|index| self.column(index)).collect();
        Some(DMatrix::from_columns(&columns?))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples of 2 exp(-3 t) with a small known disturbance.
    fn decay(x: &[f64]) -> Option<Vec<f64>> {
        let [amplitude, rate] = [x[0], x[1]];
        let residual = |k: u32| {
            let t = f64::from(k) / 50.0;
            let measured = 2.0 * (-3.0 * t).exp() + 1e-3 * (37.0 * t).sin();
            measured - amplitude * (-rate * t).exp()
        };
        (rate > 0.0).then(|| (0..50).map(residual).collect())
    }

    #[test]
    fn a_decay_is_found_with_its_errors() {
        let fit = minimise(decay, &[1.0, 1.0], &[1.0, 1.0], &NonlinearSettings::default()).unwrap();
        assert!(fit.converged);
        let covariance = fit.covariance.unwrap();
        for (index, truth) in [2.0, 3.0].into_iter().enumerate() {
            let deviation = covariance[(index, index)].sqrt();
            assert!((fit.parameters[index] - truth).abs() < 4.0 * deviation);
            assert!(deviation < 5e-3, "{deviation}");
        }
    }

    #[test]
    fn the_search_turns_back_at_the_edge_of_the_domain() {
        let settings = NonlinearSettings::default();
        let fit = minimise(decay, &[5.0, 0.01], &[1.0, 1.0], &settings).unwrap();
        assert!((fit.parameters[1] - 3.0).abs() < 1e-2);
        assert!(minimise(decay, &[1.0, -1.0], &[1.0, 1.0], &settings).is_none());
    }

    #[test]
    fn what_the_residuals_do_not_see_has_no_covariance() {
        let blind = |x: &[f64]| Some(vec![x[0] + x[1] - 1.0, x[0] + x[1] + 1.0, 0.0]);
        let settings = NonlinearSettings::default();
        let fit = minimise(blind, &[0.2, 0.3], &[1.0, 1.0], &settings).unwrap();
        assert_eq!(fit.covariance, None);
    }
}
