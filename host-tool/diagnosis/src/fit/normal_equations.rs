//! Sums over train rows: squares, their gradient and curvature, the prior's penalty in each.

use nalgebra::{DMatrix, DVector};

use super::joint_slopes::JointSlopes;
use super::unknowns::Expected;
use crate::rows::evidence::{Evidence, Rows};
use crate::trial::hypothesis::Hypothesis;

/// Train rows of each joint.
pub fn train_rows(evidence: &Evidence) -> Vec<usize> {
    (0..evidence.joint_count()).map(|joint| evidence.train_rows(joint)).collect()
}

/// Squares of train rows and of the prior penalty.
pub fn objective(
    residual: &Rows,
    train: &[usize],
    hypothesis: &Hypothesis,
    expected: &[Expected],
) -> f64 {
    let of_train = |(rows, train): (&'_ Vec<f64>, &usize)| -> f64 {
        rows.iter().take(*train).map(|r| r * r).sum()
    };
    let rows: f64 = residual.iter().zip(train).map(of_train).sum();
    let prior_penalty: f64 =
        expected.iter().map(|e| ((e.unknown.get(hypothesis) - e.mean) / e.deviation).powi(2)).sum();
    rows + prior_penalty
}

/// Half the curvature of the objective.
pub(super) fn normal(products: &DMatrix<f64>, expected: &[Expected]) -> DMatrix<f64> {
    let mut normal = products.clone();
    for (place, expected) in expected.iter().enumerate() {
        normal[(place, place)] += expected.deviation.powi(-2);
    }
    normal
}

/// Squares of each joint's train rows after a step.
pub(super) fn refitted_squares(
    joints: &[JointSlopes],
    residual: &Rows,
    step: &DVector<f64>,
) -> Vec<f64> {
    let mut squares = vec![0.0; residual.len()];
    for slopes in joints {
        let own =
            DVector::from_iterator(slopes.places.len(), slopes.places.iter().map(|p| step[*p]));
        let change = &slopes.matrix * own;
        let rows = change.iter().zip(&residual[slopes.joint]);
        squares[slopes.joint] = rows.map(|(change, row)| (row + change).powi(2)).sum();
    }
    squares
}

/// Half the gradient of the objective.
pub(super) fn gradient(
    joints: &[JointSlopes],
    residual: &Rows,
    train: &[usize],
    hypothesis: &Hypothesis,
    expected: &[Expected],
) -> DVector<f64> {
    let of_prior =
        |e: &Expected| (e.unknown.get(hypothesis) - e.mean) / (e.deviation * e.deviation);
    let mut gradient = DVector::from_iterator(expected.len(), expected.iter().map(of_prior));
    for slopes in joints {
        let rows = train[slopes.joint];
        let right = nalgebra::DVectorView::from_slice(&residual[slopes.joint][..rows], rows);
        let own = slopes.matrix.rows_range(..rows).tr_mul(&right);
        for (&place, value) in slopes.places.iter().zip(own.iter()) {
            gradient[place] += value;
        }
    }
    gradient
}
