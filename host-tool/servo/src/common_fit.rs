//! Joints fitted together: each has unknowns of its own and all have some in common.

use nalgebra::linalg::Cholesky;
use nalgebra::{DMatrix, DVector, Dyn};
use rayon::prelude::*;

use crate::cross::LeftOut;
use crate::fit::{Fitted, Normal, Problem, move_by};
use crate::joint::ServoJoint;

/// Most steps.
const ITERATIONS: usize = 10;
/// Parts of a step that are tried.
const PARTS: [f64; 3] = [1.0, 0.3, 0.1];
/// A step that takes less of the cost is the last one.
const LEAST_GAIN: f64 = 1e-3;

/// What is fitted: unknowns that are shared stand last in each joint's list.
#[derive(Debug)]
pub struct CommonFit<'a> {
    /// Joint by joint.
    pub problems: Vec<Problem<'a>>,
    /// Squares of an independent row, joint by joint [rad^2].
    pub ones: Vec<f64>,
    /// How many unknowns are shared.
    pub shared: usize,
}

/// A joint's own unknowns, eliminated from its normal equations.
struct Eliminated {
    own: Cholesky<f64, Dyn>,
    across: DMatrix<f64>,
    right: DVector<f64>,
    /// What they add to the equations of those shared.
    matrix: DMatrix<f64>,
    side: DVector<f64>,
}

impl CommonFit<'_> {
    /// The joints that leave least, from a start.
    pub fn fit(&self, mut servos: Vec<ServoJoint>) -> Vec<ServoJoint> {
        let mut before = self.cost(&servos);
        for _ in 0..ITERATIONS {
            let Some((next, after)) = self.better(&servos, before) else { break };
            let gain = before - after;
            (servos, before) = (next, after);
            if gain < LEAST_GAIN * before {
                break;
            }
        }
        servos
    }

    /// Squares in those of independent rows, and surprises of priors, of all joints.
    fn cost(&self, servos: &[ServoJoint]) -> f64 {
        let of = |((problem, servo), one): ((&Problem, &ServoJoint), &f64)| {
            problem.cost(servo, problem.robust(servo), *one)
        };
        self.problems.par_iter().zip(servos).zip(&self.ones).map(of).sum()
    }

    /// A step that leaves less, and what it leaves.
    fn better(&self, servos: &[ServoJoint], before: f64) -> Option<(Vec<ServoJoint>, f64)> {
        let pairs = self.problems.par_iter().zip(servos);
        let normals: Vec<Normal> = pairs.map(|(problem, servo)| problem.sum(servo)).collect();
        PARTS.iter().find_map(|part| {
            let next = self.stepped(servos, &normals, *part)?;
            let after = self.cost(&next);
            (after < before).then_some((next, after))
        })
    }

    /// A part of a step of Gauss and Newton's: own unknowns are eliminated joint by joint.
    fn stepped(
        &self,
        servos: &[ServoJoint],
        normals: &[Normal],
        part: f64,
    ) -> Option<Vec<ServoJoint>> {
        let joints = 0..servos.len();
        let of = |joint: usize| self.eliminated(joint, &servos[joint], &normals[joint]);
        let parts: Vec<Eliminated> = joints.map(of).collect::<Option<_>>()?;
        let zero = (DMatrix::zeros(self.shared, self.shared), DVector::zeros(self.shared));
        let (matrix, side) =
            parts.iter().fold(zero, |(m, s), joint| (m + &joint.matrix, s + &joint.side));
        let common = matrix.cholesky()?.solve(&side);
        let next = self.problems.iter().zip(servos).zip(&parts).map(|((problem, servo), joint)| {
            move_by(servo, problem.unknowns, &joint.moved(&common, part))
        });
        Some(next.collect())
    }

    fn eliminated(&self, joint: usize, servo: &ServoJoint, normal: &Normal) -> Option<Eliminated> {
        let (problem, shared) = (&self.problems[joint], self.shared);
        let (full, side) = problem.with_priors(servo, normal, self.ones[joint]);
        let count = problem.unknowns.len() - shared;
        let own = full.view((0, 0), (count, count)).clone_owned().cholesky()?;
        let across = full.view((0, count), (count, shared)).clone_owned();
        let right = side.rows(0, count).clone_owned();
        let matrix =
            full.view((count, count), (shared, shared)) - across.transpose() * own.solve(&across);
        let side = side.rows(count, shared) - across.transpose() * own.solve(&right);
        Some(Eliminated { own, across, right, matrix, side })
    }

    /// What is left of each log, all joints together.
    pub fn left(&self, servos: &[ServoJoint]) -> LeftOut {
        let logs = self.problems[0].logs.len();
        let mut sum =
            LeftOut { robust: vec![0.0; logs], squares: vec![0.0; logs], rows: vec![0; logs] };
        for ((problem, servo), one) in self.problems.iter().zip(servos).zip(&self.ones) {
            let fitted = Fitted { servo: *servo, normals: Vec::new(), square_of_one: *one };
            let left = LeftOut::of_fit(&fitted, problem);
            for log in 0..logs {
                sum.robust[log] += left.robust[log] / one;
                sum.squares[log] += left.squares[log] / one;
                sum.rows[log] += left.rows[log];
            }
        }
        sum
    }
}

impl Eliminated {
    /// A part of how far all unknowns of the joint move when those shared do.
    fn moved(&self, common: &DVector<f64>, part: f64) -> Vec<f64> {
        let own = self.own.solve(&(&self.right - &self.across * common));
        own.iter().chain(common.iter()).map(|step| part * step).collect()
    }
}
