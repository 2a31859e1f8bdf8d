//! How well many pairs of changes of one joint's rows fit, everything open refitted by the slopes of a model.

use nalgebra::{DMatrix, DVectorView, Matrix2, Vector2};

use super::gram::products_of;
use super::linearisation::Linearisation;

/// Half the gradient and the curvature of the score along two changes of rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlongPair {
    /// Half the gradient.
    pub gradient: Vector2<f64>,
    /// The curvature.
    pub curvature: Matrix2<f64>,
}

impl Linearisation {
    /// The same as [`Linearisation::along`] of every two of these changes of a joint's train rows, column by column
    /// (rows of the joint by twice the pairs).
    pub fn along_pairs(&self, joint: usize, columns: &DMatrix<f64>) -> Vec<AlongPair> {
        let against = self.against_all(joint, columns);
        let solved = self.normal.solve(&against);
        let rows = columns.nrows();
        let residual = DVectorView::from_slice(&self.residual[joint][..rows], rows);
        let pair = |first: usize| {
            let [own, against, solved] =
                [columns, &against, &solved].map(|matrix| matrix.columns(first, 2));
            let gradient = own.tr_mul(&residual) - solved.tr_mul(&self.gradient);
            let curvature = own.tr_mul(&own) - against.tr_mul(&solved);
            AlongPair {
                gradient: Vector2::new(gradient[0], gradient[1]),
                curvature: curvature.fixed_view::<2, 2>(0, 0).into(),
            }
        };
        (0..columns.ncols()).step_by(2).map(pair).collect()
    }

    /// Products of the slopes along all that is open with changes of a joint's train rows.
    fn against_all(&self, joint: usize, columns: &DMatrix<f64>) -> DMatrix<f64> {
        let mut sum = DMatrix::zeros(self.expected.len(), columns.ncols());
        for slopes in self.joints.iter().filter(|slopes| slopes.joint == joint) {
            let own = products_of(&slopes.matrix, columns);
            for (own, &place) in own.row_iter().zip(&slopes.places) {
                let mut row = sum.row_mut(place);
                row += own;
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use model::reference_robot::reference_robot;
    use rig::Plant;

    use super::*;
    use crate::criteria::Criteria;
    use crate::fit::unknowns::{Expected, Unknown};
    use crate::rows::evidence::RowChange;
    use crate::trial::hypothesis::Hypothesis;
    use crate::trial::test_stretch::rows_of_sines;

    #[test]
    fn many_pairs_at_once_are_each_as_alone() {
        let evidence = rows_of_sines(&Criteria::default());
        let hypothesis = Hypothesis::bare(Plant::of_robot(&reference_robot()));
        let open = |k: usize| Expected::new(Unknown::Base(k), hypothesis.plant.base(k), 0.1);
        let open = (0..hypothesis.plant.base_count()).map(open).collect();
        let linear = Linearisation::of(&evidence, hypothesis.clone(), open).unwrap();
        let (joint, rows) = (1, linear.train_rows(1));
        let columns = DMatrix::from_fn(rows, 20, |row, k| ((row * (k + 3)) as f64 * 0.01).sin());
        for (pair, found) in linear.along_pairs(joint, &columns).iter().enumerate() {
            let change = |k: usize| -> RowChange {
                vec![None, Some(columns.column(2 * pair + k).as_slice().to_vec()), None]
            };
            let (gradient, curvature) = linear.along(&Vec::new(), &[change(0), change(1)]);
            let close = |a: f64, b: f64| (a - b).abs() < 1e-9 * curvature.amax();
            for i in 0..2 {
                assert!(close(found.gradient[i], gradient[i]), "{pair}: {found:?}, {gradient}");
                assert!(close(found.curvature[(i, 0)], curvature[(i, 0)]), "{pair}: {found:?}");
                assert!(close(found.curvature[(i, 1)], curvature[(i, 1)]), "{pair}: {found:?}");
            }
        }
    }
}
