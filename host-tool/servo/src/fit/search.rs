//! Levenberg and Marquardt's search over whole logs.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::normal::{Normal, errors, robust};
use super::problem::Problem;
use super::unknown::Unknown;
use crate::joint::ServoJoint;
use crate::judged::Judged;

/// A joint fitted to logs.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The joint.
    pub servo: ServoJoint,
    /// Normal equations at the end, log by log.
    pub normals: Vec<Normal>,
    /// Squares of an independent row, for the weight of priors [rad^2].
    pub square_of_one: f64,
}

impl Fitted {
    /// Squares and rows of all logs.
    pub fn squares(&self) -> (f64, usize) {
        self.normals.iter().fold((0.0, 0), |(sum, n), log| (sum + log.squares, n + log.rows))
    }

    /// Rms of all logs [rad].
    pub fn rms(&self) -> f64 {
        let (sum, n) = self.squares();
        (sum / n.max(1) as f64).sqrt()
    }
}

/// The joint that leaves least of the logs and is not too far from what was likely.
pub fn fit(problem: &Problem, start: &ServoJoint) -> Fitted {
    let mut servo = *start;
    for unknown in problem.unknowns {
        let here = unknown.coordinate(&servo);
        unknown.put(&mut servo, here);
    }
    let mut normals = problem.normals(&servo);
    let mut damping = 1e-3;
    for _ in 0..problem.iterations {
        let one = problem.square_of_one(&normals);
        let robust = normals.iter().map(|log| log.robust).sum();
        let before = problem.cost(&servo, robust, one);
        let Some((next, after)) = problem.better(&servo, &normals, before, one, &mut damping)
        else {
            break;
        };
        servo = next;
        normals = problem.normals(&servo);
        if before - after < 1e-3 * before {
            break;
        }
    }
    let square_of_one = problem.square_of_one(&normals);
    Fitted { servo, normals, square_of_one }
}

impl Problem<'_> {
    fn normals(&self, servo: &ServoJoint) -> Vec<Normal> {
        let at = |log: &&Judged| Normal::at(servo, log, self).symmetric();
        self.logs.par_iter().map(at).collect()
    }

    /// What all logs cost, far blocks by their logarithm [rad^2].
    pub fn robust(&self, servo: &ServoJoint) -> f64 {
        let of = |log: &&Judged| {
            let errors = errors(servo, log, self.joint, self.step_s);
            robust(&errors, log, self.joint, self.scale)
        };
        self.logs.par_iter().map(of).sum()
    }

    fn square_of_one(&self, normals: &[Normal]) -> f64 {
        let (sum, rows) =
            normals.iter().fold((0.0, 0), |(s, n), log| (s + log.robust, n + log.rows));
        self.rows_in_one * (sum / rows.max(1) as f64).max(self.floor_rad.powi(2))
    }

    /// Squares in those of one independent row, and surprises of priors.
    pub fn cost(&self, servo: &ServoJoint, robust: f64, one: f64) -> f64 {
        let surprise = |u: &Unknown| u.surprise(u.coordinate(servo)).powi(2);
        robust / one + self.unknowns.iter().map(surprise).sum::<f64>()
    }

    /// A step that leaves less, and what it leaves.
    fn better(
        &self,
        servo: &ServoJoint,
        normals: &[Normal],
        before: f64,
        one: f64,
        damping: &mut f64,
    ) -> Option<(ServoJoint, f64)> {
        let zero = Normal::zero(self.unknowns.len());
        let sum = normals.iter().fold(zero, Normal::plus);
        for _ in 0..6 {
            let next = self.step(servo, &sum, one, *damping);
            let after = self.cost(&next, self.robust(&next), one);
            if after < before {
                *damping = (*damping * 0.2).max(1e-6);
                return Some((next, after));
            }
            *damping *= 10.0;
        }
        None
    }
}

impl Problem<'_> {
    /// Normal equations of all logs together.
    pub fn sum(&self, servo: &ServoJoint) -> Normal {
        self.normals(servo).iter().fold(Normal::zero(self.unknowns.len()), Normal::plus)
    }

    /// Normal equations with the priors' part, in squares of one independent row.
    pub fn with_priors(
        &self,
        servo: &ServoJoint,
        normal: &Normal,
        one: f64,
    ) -> (DMatrix<f64>, DVector<f64>) {
        let (mut matrix, mut right) = (&normal.matrix / one, &normal.right / one);
        for (k, unknown) in self.unknowns.iter().enumerate() {
            matrix[(k, k)] += unknown.prior.1.powi(-2);
            right[k] -= unknown.surprise(unknown.coordinate(servo)) / unknown.prior.1;
        }
        (matrix, right)
    }

    /// A damped step; what stands at a bound and would leave its range stays, and the others step without it.
    fn step(&self, servo: &ServoJoint, normal: &Normal, one: f64, damping: f64) -> ServoJoint {
        let (mut matrix, mut right) = self.with_priors(servo, normal, one);
        for k in 0..self.unknowns.len() {
            matrix[(k, k)] *= 1.0 + damping;
        }
        loop {
            let Some(factor) = matrix.clone().cholesky() else { return *servo };
            let moved = factor.solve(&right);
            let leaves = |k: &usize| self.unknowns[*k].leaves_range(servo, moved[*k]);
            let Some(held) = (0..self.unknowns.len()).find(leaves) else {
                return move_by(servo, self.unknowns, moved.as_slice());
            };
            matrix.row_mut(held).fill(0.0);
            matrix.column_mut(held).fill(0.0);
            (matrix[(held, held)], right[held]) = (1.0, 0.0);
        }
    }
}

/// A joint with its unknowns moved, within their ranges and no further than slopes reach.
pub fn move_by(servo: &ServoJoint, unknowns: &[Unknown], moved: &[f64]) -> ServoJoint {
    let mut next = *servo;
    for (unknown, moved) in unknowns.iter().zip(moved) {
        let reach = if unknown.is_log { 1.0 } else { 0.5 * (unknown.high - unknown.low) };
        unknown.put(&mut next, unknown.coordinate(servo) + moved.clamp(-reach, reach));
    }
    next
}
