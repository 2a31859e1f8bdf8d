//! Residuals of pieces of logs that the parameters were not fitted to.

use nalgebra::{Cholesky, DMatrix, DVector};

use super::joint_slopes::JointSlopes;
use super::linearisation::Linearisation;
use crate::rows::evidence::{Evidence, Rows};

impl Linearisation {
    /// Weighted train rows, each as it is left where everything open is fitted to the pieces of logs
    /// that it does not lie in: what this model leaves of it, and what the fit without those pieces
    /// changes, by the slopes. Rows held out are as they were.
    ///
    /// What a parameter gains by following what is left by chance, it loses here. A fit that is not
    /// at its end is taken as it is, and not as the slopes promise.
    pub fn left_out(&self, evidence: &Evidence) -> Rows {
        let folds = evidence.criteria.selection.folds;
        let whole = self.normal();
        let to_all = self.step_to_all();
        let mut rows = self.residual.clone();
        let of_joints: Vec<Vec<usize>> =
            self.joints.iter().map(|slopes| evidence.folds(slopes.joint)).collect();
        for fold in 0..folds {
            let Some(step) = self.step_without(&whole, &of_joints, fold) else { continue };
            for (slopes, fold_of) in self.joints.iter().zip(&of_joints) {
                let own = own(slopes, &(&step - &to_all));
                let left_out = (0..self.train[slopes.joint]).filter(|&k| fold_of[k] == fold);
                for k in left_out {
                    rows[slopes.joint][k] += slopes.matrix.row(k).dot(&own.transpose());
                }
            }
        }
        rows
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
