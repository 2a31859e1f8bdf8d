//! What a joint leaves of a log, and its normal equations.

use nalgebra::{DMatrix, DVector};

use super::problem::Problem;
use super::unknown::Unknown;
use crate::joint::ServoJoint;
use crate::judged::Judged;
use crate::replay::replay;

/// Measured less simulated position at the rows [rad; m].
pub fn errors(servo: &ServoJoint, judged: &Judged, joint: usize, step_s: f64) -> Vec<f64> {
    let record = &judged.record;
    let found = replay(servo, record, joint, &judged.along[joint], step_s);
    let read = found.read(&record.time_s, servo.read_after_s, servo.gap);
    record.joints[joint].position.iter().zip(read).map(|(q, found)| q - found).collect()
}

/// The sum of squares where the log counts, and how many rows that are.
pub fn squares(errors: &[f64], judged: &Judged, joint: usize) -> (f64, usize) {
    let kept = errors.iter().zip(&judged.counts[joint]).filter(|(_, counts)| **counts);
    kept.fold((0.0, 0), |(sum, n), (e, _)| (sum + e * e, n + 1))
}

/// Mean squares and rows of a log's blocks, where they count.
pub fn block_squares(errors: &[f64], judged: &Judged, joint: usize) -> Vec<(f64, usize)> {
    let blocks = judged.blocks.iter();
    let of = |rows: &std::ops::Range<usize>| {
        let kept = rows.clone().filter(|row| judged.counts[joint][*row]);
        let (sum, n) =
            kept.fold((0.0, 0), |(sum, n), row| (sum + errors[row] * errors[row], n + 1));
        (sum / f64::from(n.max(1)), n as usize)
    };
    blocks.map(of).collect()
}

/// What a log costs: n s ln(1 + m / s) of each block of n rows with mean square m. Blocks that the
/// model misses by far more than s weigh by their logarithm alone.
pub fn robust(errors: &[f64], judged: &Judged, joint: usize, scale: f64) -> f64 {
    let of = |(mean, rows): (f64, usize)| rows as f64 * scale * (mean / scale).ln_1p();
    block_squares(errors, judged, joint).into_iter().map(of).sum()
}

/// Normal equations of one log.
#[derive(Clone, Debug, PartialEq)]
pub struct Normal {
    /// Squares left [rad^2].
    pub squares: f64,
    /// Rows.
    pub rows: usize,
    /// Squares with far blocks by their logarithm [rad^2].
    pub robust: f64,
    /// J^T J, blocks weighted.
    pub matrix: DMatrix<f64>,
    /// J^T e; a step of (J^T J)^-1 J^T e leaves least.
    pub right: DVector<f64>,
}

impl Normal {
    /// Without any row.
    pub fn zero(p: usize) -> Self {
        let (matrix, right) = (DMatrix::zeros(p, p), DVector::zeros(p));
        Self { squares: 0.0, robust: 0.0, rows: 0, matrix, right }
    }

    /// At a joint's parameters, by differences; blocks weigh 1 / (1 + m / scale).
    pub fn at(servo: &ServoJoint, judged: &Judged, problem: &Problem) -> Self {
        let (joint, unknowns, scale) = (problem.joint, problem.unknowns, problem.scale);
        let left = errors(servo, judged, joint, problem.step_s);
        let slopes: Vec<Vec<f64>> = unknowns
            .iter()
            .map(|unknown| {
                let (other, moved) = beside(servo, unknown);
                let errors = errors(&other, judged, joint, problem.step_s);
                left.iter().zip(errors).map(|(e, other)| (e - other) / moved).collect()
            })
            .collect();
        let mut normal = Self::zero(unknowns.len());
        (normal.squares, normal.rows) = squares(&left, judged, joint);
        normal.robust = robust(&left, judged, joint, scale);
        let means = block_squares(&left, judged, joint);
        for (rows, (mean, _)) in judged.blocks.iter().zip(means) {
            let weight = 1.0 / (1.0 + mean / scale);
            for row in rows.clone().filter(|row| judged.counts[joint][*row]) {
                normal.add(weight, left[row], |k| slopes[k][row]);
            }
        }
        normal
    }

    fn add(&mut self, weight: f64, error: f64, slope: impl Fn(usize) -> f64) {
        for i in 0..self.right.len() {
            let weighted = weight * slope(i);
            self.right[i] += weighted * error;
            for k in 0..=i {
                self.matrix[(i, k)] += weighted * slope(k);
            }
        }
    }

    /// With the upper triangle as the lower.
    pub fn symmetric(mut self) -> Self {
        self.matrix.fill_upper_triangle_with_lower_triangle();
        self
    }

    /// Both together.
    pub fn plus(mut self, other: &Self) -> Self {
        self.squares += other.squares;
        self.robust += other.robust;
        self.rows += other.rows;
        self.matrix += &other.matrix;
        self.right += &other.right;
        self
    }
}

/// A joint one step of an unknown beside, within its range, and how far that is.
fn beside(servo: &ServoJoint, unknown: &Unknown) -> (ServoJoint, f64) {
    let here = unknown.coordinate(servo);
    let mut other = *servo;
    unknown.put(&mut other, here + unknown.step);
    let moved = unknown.coordinate(&other) - here;
    if moved.abs() > 0.5 * unknown.step {
        return (other, moved);
    }
    unknown.put(&mut other, here - unknown.step);
    (other, unknown.coordinate(&other) - here)
}
