//! The part of the base parameters' covariance that comes from the friction's errors.

use model::base::COUNT;
use nalgebra::{DMatrix, DVector};
use signal::estimation::LinearFit;

use super::friction::{FrictionEstimate, sensitivity};
use super::rows::Rows;
use super::solve::Stack;

/// Covariance from the friction's standard errors, taken as independent.
pub(super) fn covariance_of_friction(
    stretches: &[Rows],
    stack: &Stack,
    fit: &LinearFit,
    weight: &[f64],
    friction: &[FrictionEstimate; 3],
) -> DMatrix<f64> {
    let mut covariance = DMatrix::zeros(COUNT, COUNT);
    for (joint, estimate) in friction.iter().enumerate() {
        let errors = estimate.standard_error.to_array();
        for (parameter, error) in errors.into_iter().enumerate() {
            if error > 0.0 && error.is_finite() {
                let shift =
                    shift_by_friction(stretches, stack, fit, weight, estimate, joint, parameter);
                covariance.ger(error * error, &shift, &shift, 1.0);
            }
        }
    }
    covariance
}

/// Change of the base parameters per unit of a friction parameter.
fn shift_by_friction(
    stretches: &[Rows],
    stack: &Stack,
    fit: &LinearFit,
    weight: &[f64],
    estimate: &FrictionEstimate,
    joint: usize,
    parameter: usize,
) -> DVector<f64> {
    let slopes: Vec<Vec<f64>> = stretches
        .iter()
        .map(|rows| {
            let friction_v = rows.friction_raw_v(joint, &estimate.value);
            sensitivity(rows, joint, &estimate.value, parameter, &friction_v)
        })
        .collect();
    let mut moment = DVector::zeros(COUNT);
    for (index, at) in stack.origin.iter().enumerate().filter(|(_, at)| at.joint == joint) {
        let change = weight[index] * slopes[at.stretch][at.instant];
        moment.axpy(-change, &stack.problem.rows.row(index).transpose(), 1.0);
    }
    &fit.unit_covariance * moment
}
