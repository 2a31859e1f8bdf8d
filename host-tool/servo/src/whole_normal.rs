//! Normal equations of a joint by its own unknowns and those of an effect of the whole arm.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use crate::base::Base;
use crate::fit::{Problem, block_squares, errors, move_by};
use crate::joint::ServoJoint;
use crate::judged::Judged;

/// Steps of slopes by the effect's parameters, in parts of doubts.
pub const STEP_PART: f64 = 0.02;

/// Matrix and right side, own unknowns first, in squares of one row, priors of own unknowns
/// included. `moved[k]` are the logs with the effect's parameter k moved by 0.02 of `doubts[k]`.
pub fn normal(
    problem: &Problem,
    servo: &ServoJoint,
    moved: &[Vec<Judged>],
    doubts: &[f64],
    base: &Base,
) -> (DMatrix<f64>, DVector<f64>) {
    let (own, p) = (problem.unknowns.len(), moved.len());
    let total = own + p;
    let one = base.fitted.square_of_one;
    let of = |(number, log): (usize, &&Judged)| {
        let left = errors(servo, log, problem.joint, problem.step_s);
        let mut slopes: Vec<Vec<f64>> = Vec::with_capacity(total);
        for (k, unknown) in problem.unknowns.iter().enumerate() {
            let mut step = vec![0.0; own];
            let high = unknown.coordinate(servo) + unknown.step > unknown.top();
            step[k] = if high { -unknown.step } else { unknown.step };
            let other = move_by(servo, problem.unknowns, &step);
            let errors = errors(&other, log, problem.joint, problem.step_s);
            slopes.push(left.iter().zip(errors).map(|(e, o)| (e - o) / step[k]).collect());
        }
        for (k, logs) in moved.iter().enumerate() {
            let errors = errors(servo, &logs[number], problem.joint, problem.step_s);
            let step = STEP_PART * doubts[k];
            slopes.push(left.iter().zip(errors).map(|(e, o)| (e - o) / step).collect());
        }
        sums(&left, &slopes, log, problem)
    };
    let parts: Vec<_> = problem.logs.par_iter().enumerate().map(of).collect();
    let (mut matrix, mut right) = (DMatrix::zeros(total, total), DVector::zeros(total));
    for (part, side) in parts {
        matrix += part / one;
        right += side / one;
    }
    for (k, unknown) in problem.unknowns.iter().enumerate() {
        matrix[(k, k)] += unknown.prior.1.powi(-2);
        right[k] -= unknown.surprise(unknown.coordinate(servo)) / unknown.prior.1;
    }
    (matrix, right)
}

fn sums(
    left: &[f64],
    slopes: &[Vec<f64>],
    log: &Judged,
    problem: &Problem,
) -> (DMatrix<f64>, DVector<f64>) {
    let total = slopes.len();
    let (mut matrix, mut right) = (DMatrix::zeros(total, total), DVector::zeros(total));
    let means = block_squares(left, log, problem.joint);
    for (rows, (mean, _)) in log.blocks.iter().zip(means) {
        let weight = 1.0 / (1.0 + mean / problem.scale);
        for row in rows.clone().filter(|row| log.counts[problem.joint][*row]) {
            let column = DVector::from_fn(total, |k, _| slopes[k][row]);
            right.axpy(weight * left[row], &column, 1.0);
            matrix.ger(weight, &column, &column, 1.0);
        }
    }
    (matrix, right)
}
