//! Residuals of pieces of logs that the parameters were not fitted to.

use nalgebra::{Cholesky, DMatrix, DVector, DVectorView};

use super::gram::{self, Run, runs};
use super::joint_slopes::JointSlopes;
use super::linearisation::Linearisation;
use crate::rows::evidence::{Evidence, Rows};

/// 97.5 % quantile of Student's t at four degrees of freedom, for five folds.
const STUDENT_T: f64 = 2.776;
/// The same of the normal distribution.
pub const NORMAL: f64 = 1.96;
/// A change of so many standard deviations may be chance. What play was told by as a lag, or a delay, differed from log to
/// log by 4 to 22 of them (six axes, seed 95531), six lags and delays that were there by 0.7 to 2.8 (diverse seeds up to
/// 60777).
const CHANCE_DEVIATIONS: f64 = 3.0;

impl Linearisation {
    /// Weighted train rows, each as it is left where everything open is fitted to the pieces of logs
    /// that it does not lie in: what this model leaves of it, and what the fit without those pieces
    /// changes, by the slopes. Rows held out are as they were.
    ///
    /// What a parameter gains by following what is left by chance, it loses here. A fit that is not
    /// at its end is taken as it is, and not as the slopes promise.
    pub fn left_out(&self, evidence: &Evidence) -> Rows {
        let mut rows = self.residual.clone();
        let runs = self.runs(&self.folds(evidence));
        let changes = self.changes_without(self.normal_within_slopes(), &runs, &self.of_folds);
        for (slopes, runs) in self.joints.iter().zip(&runs) {
            for run in runs {
                let Some(change) = &changes[run.group] else { continue };
                let (from, count) = (run.rows.start, run.rows.len());
                let left_out = slopes.matrix.rows(from, count) * own(slopes, change);
                let rows = &mut rows[slopes.joint][run.rows.clone()];
                rows.iter_mut().zip(left_out.iter()).for_each(|(row, change)| *row += change);
            }
        }
        rows
    }

    /// Half the 95 % interval of each parameter that is open: by the curvature of the fit, or by what
    /// leaving out one fold after the other or one log after the other changes, whichever is most. What a
    /// model leaves of a machine differs from one stretch of motion and from one kind of motion to the
    /// next, and only that shows it. Logs are few, and one may hold most of what is known of a parameter,
    /// so that their deviation counts as one that is known.
    pub fn half_intervals(&self, evidence: &Evidence) -> Vec<f64> {
        let logs = self.runs(&self.train_logs(evidence));
        let by_logs = self.jackknife_deviations(&logs, &self.products_of_logs(evidence, &logs));
        self.wider_half_intervals(evidence, &by_logs)
    }

    /// The same, by what leaving out one log changes beyond chance alone: one log may be the only one that tells a
    /// parameter, and what the others say of it then differs by what they do not know.
    ///
    /// What the fit to a part of the rows differs by from the one to all has the variance of the first less that of the
    /// second (Hausman, Specification tests in econometrics, 1978).
    pub fn half_intervals_beyond_chance(&self, evidence: &Evidence) -> Vec<f64> {
        let logs = self.runs(&self.train_logs(evidence));
        let products = self.products_of_logs(evidence, &logs);
        let (normal, variances) = (self.normal(), self.variances());
        let changes = self.changes_without(normal.clone(), &logs, &products);
        let beyond = |(change, product): (Option<DVector<f64>>, &DMatrix<f64>)| {
            let without = Cholesky::new(&normal - product)?.inverse().diagonal();
            Some(change?.zip_map(&(without - &variances), more_than_chance))
        };
        let beyond: Vec<_> = changes.into_iter().zip(&products).filter_map(beyond).collect();
        self.wider_half_intervals(evidence, &jackknife(&beyond, self.expected.len()))
    }

    /// Variances of all that is open, by the curvature of the fit.
    fn variances(&self) -> DVector<f64> {
        self.normal.inverse().diagonal()
    }

    /// Half the 95 % interval of each parameter that is open, by the curvature of the fit, by folds, or by a deviation
    /// between logs.
    fn wider_half_intervals(&self, evidence: &Evidence, by_logs: &DVector<f64>) -> Vec<f64> {
        let folds = self.runs(&self.folds(evidence));
        let by_folds = self.jackknife_deviations(&folds, &self.of_folds) * STUDENT_T;
        let wider =
            |place: usize| by_folds[place].max(NORMAL * self.deviation(place).max(by_logs[place]));
        (0..self.expected.len()).map(wider).collect()
    }

    /// Products of the slopes over the rows of each train log.
    fn products_of_logs(&self, evidence: &Evidence, logs: &[Vec<Run>]) -> Vec<DMatrix<f64>> {
        gram::by_groups(&self.joints, logs, evidence.train_logs(), self.expected.len())
    }

    /// The train log of every row, joint by joint.
    fn train_logs(&self, evidence: &Evidence) -> Vec<Vec<usize>> {
        self.joints.iter().map(|slopes| evidence.logs_of_rows(slopes.joint)).collect()
    }

    /// Standard deviations of what is open, by what leaving out each group of rows changes.
    fn jackknife_deviations(&self, runs: &[Vec<Run>], products: &[DMatrix<f64>]) -> DVector<f64> {
        let changes: Vec<DVector<f64>> =
            self.changes_without(self.normal(), runs, products).into_iter().flatten().collect();
        jackknife(&changes, self.expected.len())
    }

    /// The normal matrix with a prior of the range in which slopes hold (`Unknown::linear_range`), so that steps
    /// which rows do not ask for stay within it.
    fn normal_within_slopes(&self) -> DMatrix<f64> {
        let mut normal = self.normal();
        for (place, expected) in self.expected.iter().enumerate() {
            if let Some(range) = expected.unknown.linear_range(&self.hypothesis) {
                normal[(place, place)] += range.max(1e-9).powi(-2);
            }
        }
        normal
    }

    /// By how much the fit to all train rows but those of a group differs from the one to all, whose normal
    /// matrix is `whole`, group by group, by the products of the slopes over each group's rows.
    fn changes_without(
        &self,
        whole: DMatrix<f64>,
        runs: &[Vec<Run>],
        products: &[DMatrix<f64>],
    ) -> Vec<Option<DVector<f64>>> {
        let Some(cholesky) = Cholesky::new(whole.clone()) else {
            return vec![None; products.len()];
        };
        let to_all = -cholesky.solve(&self.gradient);
        let gradients = self.gradients_without(runs, products.len());
        let both = products.iter().zip(&gradients);
        let change = |(products, gradient): (&DMatrix<f64>, &DVector<f64>)| {
            Some(-Cholesky::new(&whole - products)?.solve(gradient) - &to_all)
        };
        both.map(change).collect()
    }

    /// Half the gradient of the objective without each group's rows.
    fn gradients_without(&self, runs: &[Vec<Run>], groups: usize) -> Vec<DVector<f64>> {
        let mut gradients = vec![self.gradient.clone(); groups];
        for (slopes, runs) in self.joints.iter().zip(runs) {
            let residual = &self.residual[slopes.joint];
            for run in runs {
                let right = DVectorView::from_slice(&residual[run.rows.clone()], run.rows.len());
                let own = slopes.matrix.rows(run.rows.start, run.rows.len()).tr_mul(&right);
                for (&place, product) in slopes.places.iter().zip(own.iter()) {
                    gradients[run.group][place] -= product;
                }
            }
        }
        gradients
    }

    /// The fold of every row, joint by joint.
    fn folds(&self, evidence: &Evidence) -> Vec<Vec<usize>> {
        self.joints.iter().map(|slopes| evidence.folds(slopes.joint)).collect()
    }

    /// Runs of rows of one group, joint by joint.
    fn runs(&self, group_of: &[Vec<usize>]) -> Vec<Vec<Run>> {
        group_of.iter().map(|group_of| runs(group_of)).collect()
    }
}

/// Standard deviations by what leaving out each of F groups changes: sqrt((F - 1)/F sum(change^2)), the delete-a-group
/// jackknife (Kott, 2001).
fn jackknife(changes: &[DVector<f64>], parameters: usize) -> DVector<f64> {
    let part = 1.0 - 1.0 / changes.len().max(1) as f64;
    let zero = DVector::zeros(parameters);
    let squares = changes.iter().fold(zero, |sum, change| sum + change.component_mul(change));
    squares.map(|square| (part * square).sqrt())
}

/// What of a change is more than chance alone explains, which has this variance.
fn more_than_chance(change: f64, variance: f64) -> f64 {
    (change.powi(2) - CHANCE_DEVIATIONS.powi(2) * variance.max(0.0)).max(0.0).sqrt()
}

/// The part of a step that a joint's slopes belong to.
fn own(slopes: &JointSlopes, step: &DVector<f64>) -> DVector<f64> {
    DVector::from_iterator(slopes.places.len(), slopes.places.iter().map(|&place| step[place]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Play of 95 and of 7 mrad, told as lags of 62 and 17 ms, and a delay of 2.8 ms that one log alone tells.
    #[test]
    fn what_one_log_alone_tells_differs_by_chance_from_what_others_do() {
        let variance = |without: f64, with: f64| without * without - with * with;
        let play = more_than_chance(-28.6e-3, variance(2.34e-3, 1.93e-3));
        assert!(play > 0.9 * 28.6e-3, "{play}");
        let narrow_play = more_than_chance(-5.34e-3, variance(1.67e-3, 1.15e-3));
        assert!(narrow_play > 0.7 * 5.34e-3, "{narrow_play}");
        assert_eq!(more_than_chance(0.569e-3, variance(0.436e-3, 0.051e-3)), 0.0);
    }
}
