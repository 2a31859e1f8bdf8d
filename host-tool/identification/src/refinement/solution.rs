//! One step of Gauss-Newton, with its covariance.

use model::base::COUNT;
use model::{BaseParameters, Friction};
use nalgebra::{DMatrix, DVector};

use super::super::base_parameters::friction::{ALPHA2, FrictionEstimate, magnitude};
use super::super::base_parameters::solve::Stack;
use super::layout::{Layout, TIMING_COUNT, UNDETERMINED};
use super::model_uncertainty::ModelUncertainty;
use signal::estimation::LinearProblem;
use signal::estimation::autocorrelation::score_covariance;

/// A Gauss-Newton step with its covariance.
pub(super) struct Solution {
    /// Base parameters, lags, and changes of the free friction parameters.
    pub parameters: DVector<f64>,
    pub covariance: DMatrix<f64>,
    pub residuals: DVector<f64>,
    pub weight: Vec<f64>,
}

impl Solution {
    /// Solves with the given weights, or with those that follow from the residuals.
    pub fn of(
        stack: &Stack,
        prior: &LinearProblem,
        block_s: f64,
        weight: Option<Vec<f64>>,
    ) -> Option<Self> {
        let solve = |weight: &[f64]| {
            let (parameters, unit) = with_prior(&stack.problem, weight, prior).solve_fast()?;
            let residuals = &stack.problem.right - &stack.problem.rows * &parameters;
            Some((parameters, unit, residuals))
        };
        let weight = match weight {
            Some(weight) => weight,
            None => {
                // A hundredth of a volt is about what unrefined friction leaves.
                let (_, _, first) = solve(&vec![1e4; stack.origin.len()])?;
                let (_, _, second) = solve(&stack.weights(&first, true))?;
                stack.weights(&second, true)
            }
        };
        let (parameters, unit, residuals) = solve(&weight)?;
        let weighted = stack.problem.clone().weighted(&weight);
        let left = &weighted.right - &weighted.rows * &parameters;
        let blocks = stack.blocks(block_s);
        let scores = score_covariance(&weighted.rows, &left, &blocks);
        let known = prior.rows.tr_mul(&prior.rows);
        // Residuals of a fit are smaller than the errors: one block is spent per parameter
        // that the data, not the prior, determine.
        let determined = unit.ncols() as f64 - (&unit * &known).trace();
        let blocks = blocks.len() as f64;
        let spent = blocks / (blocks - determined).max(1.0);
        let covariance = &unit * (scores * spent + known) * &unit;
        Some(Self { parameters, covariance, residuals, weight })
    }

    /// Friction after a step, and the step's largest part in standard errors.
    ///
    /// A step changes no value by more than a third, so that none leaves its range.
    pub fn applied_to(
        &self,
        from: &[Friction<f64>; 3],
        layout: &Layout,
    ) -> ([Friction<f64>; 3], f64) {
        let mut values = from.each_ref().map(Friction::to_array);
        let mut largest = 0.0f64;
        let moving =
            layout.free.iter().enumerate().filter(|(_, free)| !UNDETERMINED.contains(&free.1));
        for (index, &(joint, parameter)) in moving {
            let column = layout.column(index);
            let wanted = self.parameters[column];
            let error = self.covariance[(column, column)].sqrt();
            let scale = magnitude(&values[joint], parameter);
            let allowed = if parameter == ALPHA2 { f64::INFINITY } else { scale.abs() / 3.0 };
            values[joint][parameter] += wanted.clamp(-allowed, allowed);
            largest = largest.max(wanted.abs() / error);
        }
        for joint in &mut values {
            joint[ALPHA2] = joint[ALPHA2].max(0.0);
        }
        (values.map(Friction::from_array), largest)
    }

    /// The same with the model's uncertainty in its covariance.
    pub fn with_model_uncertainty(
        mut self,
        uncertainty: &ModelUncertainty,
        layout: &Layout,
        friction: &[Friction<f64>; 3],
    ) -> Self {
        let base = BaseParameters::from_array(std::array::from_fn(|k| self.parameters[k]));
        for (k, error) in uncertainty.of_base(&base).into_iter().enumerate() {
            self.covariance[(k, k)] += error * error;
        }
        for (index, &(joint, parameter)) in layout.free.iter().enumerate() {
            let error = uncertainty.of_friction(&friction[joint].to_array(), parameter);
            let column = layout.column(index);
            self.covariance[(column, column)] += error * error;
        }
        self
    }
}

/// The earlier steps' estimates as equations of variance one.
pub(super) fn prior_rows(
    layout: &Layout,
    friction: &[FrictionEstimate; 3],
    current: &[Friction<f64>; 3],
    timing_s: f64,
) -> LinearProblem {
    let count = COUNT + layout.extra_count();
    let mut entries: Vec<(usize, f64, f64)> =
        (0..TIMING_COUNT).map(|k| (COUNT + k, 0.0, timing_s)).collect();
    for (index, &(joint, parameter)) in layout.free.iter().enumerate() {
        let error = friction[joint].standard_error.to_array()[parameter];
        if error.is_finite() {
            let known = friction[joint].value.to_array()[parameter];
            let change = known - current[joint].to_array()[parameter];
            entries.push((layout.column(index), change, error));
        }
    }
    let mut rows = DMatrix::zeros(entries.len(), count);
    for (row, &(column, _, error)) in entries.iter().enumerate() {
        rows[(row, column)] = 1.0 / error;
    }
    let right = DVector::from_iterator(entries.len(), entries.iter().map(|e| e.1 / e.2));
    LinearProblem { rows, right }
}

/// Weighted equations with the prior's below them.
fn with_prior(problem: &LinearProblem, weight: &[f64], prior: &LinearProblem) -> LinearProblem {
    let weighted = problem.clone().weighted(weight);
    let (data, more, columns) = (weighted.rows.nrows(), prior.rows.nrows(), weighted.rows.ncols());
    let mut rows = DMatrix::zeros(data + more, columns);
    rows.rows_mut(0, data).copy_from(&weighted.rows);
    rows.rows_mut(data, more).copy_from(&prior.rows);
    let mut right = DVector::zeros(data + more);
    right.rows_mut(0, data).copy_from(&weighted.right);
    right.rows_mut(data, more).copy_from(&prior.right);
    LinearProblem { rows, right }
}
