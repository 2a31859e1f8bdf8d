//! Residuals of pieces of logs that the parameters were not fitted to.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::joint_slopes::JointSlopes;
use super::linearisation::Linearisation;
use crate::rows::evidence::{Evidence, Rows};

/// 97.5 % quantile of Student's t at four degrees of freedom, for five folds.
const STUDENT_T: f64 = 2.776;
/// The same of the normal distribution.
pub const NORMAL: f64 = 1.96;

impl Linearisation {
    /// Weighted train rows, each as it is left where everything open is fitted to the pieces of logs
    /// that it does not lie in: what this model leaves of it, and what the fit without those pieces
    /// changes, by the slopes. Rows held out are as they were.
    ///
    /// What a parameter gains by following what is left by chance, it loses here. A fit that is not
    /// at its end is taken as it is, and not as the slopes promise.
    pub fn left_out(&self, evidence: &Evidence) -> Rows {
        let mut rows = self.residual.clone();
        let of_joints = self.folds(evidence);
        let folds = evidence.criteria.selection.folds;
        let normal = self.normal_within_slopes();
        let changes = self.changes_without(normal, &of_joints, folds);
        for (fold, change) in changes.into_iter().enumerate() {
            let Some(change) = change else { continue };
            for (slopes, fold_of) in self.joints.iter().zip(&of_joints) {
                let own = own(slopes, &change);
                let left_out = (0..self.train[slopes.joint]).filter(|&k| fold_of[k] == fold);
                for k in left_out {
                    rows[slopes.joint][k] += slopes.matrix.row(k).dot(&own.transpose());
                }
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
        let folds = evidence.criteria.selection.folds;
        let by_folds = self.jackknife_deviations(&self.folds(evidence), folds) * STUDENT_T;
        let logs: Vec<Vec<usize>> =
            self.joints.iter().map(|slopes| evidence.logs_of_rows(slopes.joint)).collect();
        let by_logs = self.jackknife_deviations(&logs, evidence.train_logs());
        let wider = |place: usize| {
            let deviation = self.deviation(place).max(by_logs[place]);
            by_folds[place].max(NORMAL * deviation)
        };
        (0..self.expected.len()).map(wider).collect()
    }

    /// Standard deviations of what is open: sqrt((F - 1)/F sum(change^2)), the delete-a-group jackknife
    /// (Kott, 2001).
    fn jackknife_deviations(&self, group_of: &[Vec<usize>], groups: usize) -> DVector<f64> {
        let changes: Vec<DVector<f64>> =
            self.changes_without(self.normal(), group_of, groups).into_iter().flatten().collect();
        let part = 1.0 - 1.0 / changes.len().max(1) as f64;
        let zero = DVector::zeros(self.expected.len());
        let squares = changes.iter().fold(zero, |sum, change| sum + change.component_mul(change));
        squares.map(|square| (part * square).sqrt())
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
    /// matrix is `whole`, group by group; rows of each joint have their groups in `group_of`.
    fn changes_without(
        &self,
        whole: DMatrix<f64>,
        group_of: &[Vec<usize>],
        groups: usize,
    ) -> Vec<Option<DVector<f64>>> {
        let Some(cholesky) = Cholesky::new(whole.clone()) else { return vec![None; groups] };
        let to_all = -cholesky.solve(&self.gradient);
        let change = |group| Some(self.step_without(&whole, group_of, group)? - &to_all);
        (0..groups).map(change).collect()
    }

    /// The fold of every row, joint by joint.
    fn folds(&self, evidence: &Evidence) -> Vec<Vec<usize>> {
        self.joints.iter().map(|slopes| evidence.folds(slopes.joint)).collect()
    }

    /// The step that fits best to all train rows but those of a fold.
    fn step_without(
        &self,
        whole: &DMatrix<f64>,
        fold_of: &[Vec<usize>],
        fold: usize,
    ) -> Option<DVector<f64>> {
        let (mut normal, mut gradient) = (whole.clone(), self.gradient.clone());
        for (slopes, fold_of) in self.joints.iter().zip(fold_of) {
            let count = self.train[slopes.joint];
            let rows: Vec<usize> = (0..count).filter(|&k| fold_of[k] == fold).collect();
            let matrix = slopes.matrix.select_rows(&rows);
            let residual = &self.residual[slopes.joint];
            let right = DVector::from_iterator(rows.len(), rows.iter().map(|&k| residual[k]));
            let (products, own) = (matrix.tr_mul(&matrix), matrix.tr_mul(&right));
            for (a, &place_a) in slopes.places.iter().enumerate() {
                gradient[place_a] -= own[a];
                for (b, &place_b) in slopes.places.iter().enumerate() {
                    normal[(place_a, place_b)] -= products[(a, b)];
                }
            }
        }
        Some(-Cholesky::new(normal)?.solve(&gradient))
    }
}

/// The part of a step that a joint's slopes belong to.
fn own(slopes: &JointSlopes, step: &DVector<f64>) -> DVector<f64> {
    DVector::from_iterator(slopes.places.len(), slopes.places.iter().map(|&place| step[place]))
}
