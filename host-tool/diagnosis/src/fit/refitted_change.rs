//! How well a change of the rows fits once everything open is refitted, by the slopes of a model.

use nalgebra::{DMatrix, DVector};

use super::linearisation::Linearisation;
use crate::rows::evidence::RowChange;
use crate::trial::hypothesis::EffectInstance;

impl Linearisation {
    /// Squares of train rows and of the prior penalty, everything open refitted by the slopes.
    pub fn refitted_objective(&self) -> f64 {
        self.objective_with(&RowChange::default())
    }

    /// Squares of the train rows that an effect acts on, everything open refitted by the slopes.
    pub fn squares_of(&self, effect: &EffectInstance) -> f64 {
        let counts = |joint: usize| effect.joint == 0 || joint + 1 == usize::from(effect.joint);
        let squares = self.refitted_squares.iter().enumerate();
        squares.filter(|(joint, _)| counts(*joint)).map(|(_, squares)| squares).sum()
    }

    /// The same of all joints' rows.
    pub fn squares(&self) -> f64 {
        self.refitted_squares.iter().sum()
    }

    /// Squares of train rows and of the prior penalty once train rows change so,
    /// everything open refitted by the slopes.
    pub fn objective_with(&self, change: &RowChange) -> f64 {
        let gradient = &self.gradient + self.against(change);
        let step = -self.normal.solve(&gradient);
        let mut objective = self.objective + gradient.dot(&step);
        for joint in 0..self.residual.len() {
            let both = column(change, joint).iter().zip(&self.residual[joint]);
            objective += both.take(self.train[joint]).map(|(c, r)| c * (c + 2.0 * r)).sum::<f64>();
        }
        objective
    }

    /// Slopes' products with a change of the train rows.
    fn against(&self, change: &RowChange) -> DVector<f64> {
        let mut sum = DVector::zeros(self.expected.len());
        for slopes in self.joints.iter() {
            let Some(Some(column)) = change.get(slopes.joint) else { continue };
            let rows = self.train[slopes.joint];
            let products = slopes
                .matrix
                .rows_range(..rows)
                .tr_mul(&nalgebra::DVectorView::from_slice(&column[..rows], rows));
            for (&place, value) in slopes.places.iter().zip(products.iter()) {
                sum[place] += value;
            }
        }
        sum
    }

    /// Half the gradient and the curvature of the score along changes of rows, about a
    /// change of rows, everything open refitted.
    pub fn along(&self, about: &RowChange, slopes: &[RowChange]) -> (DVector<f64>, DMatrix<f64>) {
        let count = slopes.len();
        let against: Vec<DVector<f64>> = slopes.iter().map(|rows| self.against(rows)).collect();
        let solved: Vec<DVector<f64>> = against.iter().map(|b| self.normal.solve(b)).collect();
        let gradient = &self.gradient + self.against(about);
        let product = |joint: usize, a: &[f64], b: &[f64]| -> f64 {
            a.iter().zip(b).take(self.train[joint]).map(|(a, b)| a * b).sum()
        };
        let of_changes = |a: &RowChange, b: &RowChange| -> f64 {
            (0..self.train.len())
                .map(|joint| product(joint, column(a, joint), column(b, joint)))
                .sum()
        };
        let with_residual = |a: &RowChange| -> f64 {
            let of_joint = |joint| product(joint, column(a, joint), &self.residual[joint]);
            (0..self.train.len()).map(of_joint).sum()
        };
        let half_gradient = DVector::from_fn(count, |i, _| {
            with_residual(&slopes[i]) + of_changes(&slopes[i], about) - solved[i].dot(&gradient)
        });
        let curvature = DMatrix::from_fn(count, count, |i, k| {
            of_changes(&slopes[i], &slopes[k]) - against[i].dot(&solved[k])
        });
        (half_gradient, curvature)
    }
}

/// A joint's rows of a change; none where they do not change.
fn column(change: &RowChange, joint: usize) -> &[f64] {
    change.get(joint).and_then(Option::as_deref).unwrap_or_default()
}
