//! The estimates over the number of samples, Fig. 9.

use model::base::COUNT;
use nalgebra::{DMatrix, DVector};

use super::solve::Stack;

/// The estimates from the first part of the log.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvergencePoint {
    /// Equations per joint up to here.
    pub samples: usize,
    /// The base parameters, in the order of [`model::base::NAMES`].
    pub values: [f64; COUNT],
}

/// Estimates at `points` numbers of samples, evenly spaced, from where the equations
/// determine all parameters.
///
/// Normal equations grow as the samples come; what they lose in digits against an
/// orthogonal solution, J_k squared times 1e-16, no diagram shows.
pub fn convergence(stack: &Stack, weight: &[f64], points: usize) -> Vec<ConvergencePoint> {
    let (rows, right) = (&stack.problem.rows, &stack.problem.right);
    let mut normal = DMatrix::<f64>::zeros(COUNT, COUNT);
    let mut moment = DVector::<f64>::zeros(COUNT);
    let every = (stack.origin.len() / points.max(1)).max(1);
    let mut found = Vec::new();
    for (index, &weight) in weight.iter().enumerate() {
        let row = rows.row(index).columns(0, COUNT).transpose();
        normal.ger(weight, &row, &row, 1.0);
        moment.axpy(weight * right[index], &row, 1.0);
        if (index + 1) % every == 0 {
            let samples = (index + 1).div_ceil(3);
            found.extend(
                solution(&normal, &moment).map(|values| ConvergencePoint { samples, values }),
            );
        }
    }
    found
}

fn solution(normal: &DMatrix<f64>, moment: &DVector<f64>) -> Option<[f64; COUNT]> {
    let factor = normal.clone().cholesky()?;
    let diagonal = factor.l_dirty().diagonal();
    if diagonal.min() < 1e-4 * diagonal.max() {
        return None;
    }
    let values = factor.solve(moment);
    Some(std::array::from_fn(|k| values[k]))
}
