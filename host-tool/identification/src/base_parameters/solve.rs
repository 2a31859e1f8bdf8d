//! From equations to parameters: robust weights, and covariances that allow for correlation.

use model::base::COUNT;
use nalgebra::{DMatrix, DVector};

use super::rows::Rows;
use signal::estimation::autocorrelation::{clustered_covariance, effective_samples};
use signal::estimation::{LinearFit, LinearProblem};

/// The equations of all stretches, stacked.
#[derive(Clone, Debug)]
pub struct Stack {
    /// Where each equation comes from.
    pub origin: Vec<Origin>,
    /// Phi and y.
    pub problem: LinearProblem,
}

/// Columns of one joint behind the base parameters, each with its place.
pub type ExtraColumns = Vec<(usize, Vec<f64>)>;

/// Where an equation comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Origin {
    /// Index of the stretch.
    pub stretch: usize,
    /// Index of the joint, 0 to 2.
    pub joint: usize,
    /// Index of the instant.
    pub instant: usize,
    /// Time in the log [s].
    pub time_s: f64,
}

impl Stack {
    /// Stacks equations in the order of time, `right` giving y of a stretch and joint,
    /// with columns for further parameters behind the base parameters.
    pub fn new(
        stretches: &[Rows],
        right: &[[Vec<f64>; 3]],
        extra: &[[ExtraColumns; 3]],
        extra_count: usize,
    ) -> Self {
        let origin = origins(stretches);
        let mut rows = DMatrix::zeros(origin.len(), COUNT + extra_count);
        let mut y = DVector::zeros(origin.len());
        for (index, at) in origin.iter().enumerate() {
            let joint = &stretches[at.stretch].joints[at.joint];
            for (parameter, column) in joint.columns.iter().enumerate() {
                rows[(index, parameter)] = column.get(at.instant).copied().unwrap_or(0.0);
            }
            for (place, column) in extra.get(at.stretch).map_or(&[][..], |m| &m[at.joint][..]) {
                rows[(index, COUNT + place)] = column[at.instant];
            }
            y[index] = right[at.stretch][at.joint][at.instant];
        }
        Self { origin, problem: LinearProblem { rows, right: y } }
    }

    /// Splits a value per equation by joint.
    pub fn by_joint(&self, values: &DVector<f64>) -> [Vec<f64>; 3] {
        [0, 1, 2].map(|joint| {
            let of_joint =
                self.origin.iter().zip(values.iter()).filter(|(at, _)| at.joint == joint);
            of_joint.map(|(_, value)| *value).collect()
        })
    }

    /// Equations of all joints within the same `length_s` of a stretch, together.
    pub fn blocks(&self, length_s: f64) -> Vec<Vec<usize>> {
        let mut blocks = std::collections::BTreeMap::<(usize, i64), Vec<usize>>::new();
        for (index, at) in self.origin.iter().enumerate() {
            let key = (at.stretch, (at.time_s / length_s).floor() as i64);
            blocks.entry(key).or_default().push(index);
        }
        blocks.into_values().collect()
    }

    /// Weights 1/variance of each joint's residuals, those of outliers lowered (Huber),
    /// divided by how often each piece of information is repeated.
    pub fn weights(&self, residuals: &DVector<f64>, robust: bool) -> Vec<f64> {
        /// Residuals beyond so many deviations are taken for outliers.
        const HUBER: f64 = 2.0;
        let by_joint = self.by_joint(residuals);
        let deviation = by_joint.each_ref().map(|r| robust_deviation(r));
        let repeated = by_joint.each_ref().map(|r| effective_samples(r) / r.len().max(1) as f64);
        let weight = |at: &Origin, residual: f64| {
            let relative = residual.abs() / deviation[at.joint];
            let trust = if robust && relative > HUBER { HUBER / relative } else { 1.0 };
            trust * repeated[at.joint] / deviation[at.joint].powi(2)
        };
        self.origin.iter().zip(residuals.iter()).map(|(at, &r)| weight(at, r)).collect()
    }

    /// Solves with weights that follow from the residuals, three times over.
    pub fn solve_weighted(&self, robust: bool) -> Option<(LinearFit, Vec<f64>)> {
        let mut fit = self.problem.solve()?;
        let mut weight = vec![1.0; self.origin.len()];
        for _ in 0..3 {
            let residuals = &self.problem.right - &self.problem.rows * &fit.parameters;
            weight = self.weights(&residuals, robust);
            fit = self.problem.clone().weighted(&weight).solve()?;
        }
        Some((fit, weight))
    }

    /// Covariance of a weighted solution from the residuals' own correlation.
    pub fn covariance(&self, fit: &LinearFit, weight: &[f64], block_s: f64) -> DMatrix<f64> {
        let weighted = self.problem.clone().weighted(weight);
        let residuals = &weighted.right - &weighted.rows * &fit.parameters;
        clustered_covariance(
            &weighted.rows,
            &residuals,
            &fit.unit_covariance,
            &self.blocks(block_s),
        )
    }
}

/// Every usable equation, by time within a stretch, so that the first n of them are those
/// of the first part of the log.
fn origins(stretches: &[Rows]) -> Vec<Origin> {
    let mut origins = Vec::new();
    for (stretch, rows) in stretches.iter().enumerate() {
        for (instant, &time_s) in rows.time_s.iter().enumerate() {
            let usable = (0..3).filter(|&joint| instant >= rows.joints[joint].first);
            origins.extend(usable.map(|joint| Origin { stretch, joint, instant, time_s }));
        }
    }
    origins
}

/// Standard deviation by the median of the absolute values, which outliers do not move.
pub fn robust_deviation(residuals: &[f64]) -> f64 {
    const NORMAL: f64 = 1.4826;
    let mut absolute: Vec<f64> = residuals.iter().map(|r| r.abs()).collect();
    if absolute.is_empty() {
        return f64::NAN;
    }
    let middle = absolute.len() / 2;
    let (_, median, _) = absolute.select_nth_unstable_by(middle, f64::total_cmp);
    (NORMAL * *median).max(f64::MIN_POSITIVE)
}
