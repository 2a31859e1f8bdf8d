//! All rows of a model linearised in what is open.

use std::sync::Arc;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use rayon::prelude::*;

use super::earlier::Earlier;
use super::gram;
use super::joint_slopes::JointSlopes;
use super::normal_equations::{gradient, normal, objective, refitted_squares, train_rows};
use super::slopes::slopes;
use super::unknowns::{Expected, Unknown};
use crate::rows::evidence::{Evidence, Rows};
use crate::trial::hypothesis::Hypothesis;
use crate::trial::parts::Parts;

/// A model with its residuals and their slopes.
#[derive(Clone)]
pub struct Linearisation {
    /// The model.
    pub hypothesis: Hypothesis,
    /// What is open in it.
    pub expected: Vec<Expected>,
    /// What it leaves of train rows, in units of noise.
    pub residual: Rows,
    /// Squares of train rows and of the prior penalty.
    pub objective: f64,
    /// What the model's equation consists of, stretch by stretch, joint by joint.
    pub(super) parts: Arc<[Vec<Parts>]>,
    pub(crate) joints: Arc<[JointSlopes]>,
    /// Half the gradient of the objective.
    pub(super) gradient: DVector<f64>,
    /// Products of the slopes over all train rows.
    products: Arc<DMatrix<f64>>,
    /// The same over the rows of each fold.
    pub(super) of_folds: Arc<[DMatrix<f64>]>,
    pub(super) normal: Cholesky<f64, Dyn>,
    /// Squares of each joint's train rows, everything open refitted by the slopes.
    pub(super) refitted_squares: Vec<f64>,
    pub(crate) train: Vec<usize>,
}

impl Linearisation {
    /// Linearises a model; `expected` must name its effects' parameters too.
    /// `None` where the numbers do not work out.
    pub fn of(
        evidence: &Evidence,
        hypothesis: Hypothesis,
        expected: Vec<Expected>,
    ) -> Option<Self> {
        Self::with_slopes_of(&Earlier::default(), evidence, hypothesis, expected)
    }

    /// A model that differs from this one in a few effects or tables: slopes that both have are taken
    /// from here, where the rows have the same weights.
    pub fn near(
        &self,
        evidence: &Evidence,
        hypothesis: Hypothesis,
        expected: Vec<Expected>,
    ) -> Option<Self> {
        let here = (&self.hypothesis, &self.expected[..]);
        let earlier = Earlier::of(&self.joints, here, (&hypothesis, &expected));
        Self::with_slopes_of(&earlier, evidence, hypothesis, expected)
    }

    fn with_slopes_of(
        earlier: &Earlier,
        evidence: &Evidence,
        hypothesis: Hypothesis,
        expected: Vec<Expected>,
    ) -> Option<Self> {
        let train = train_rows(evidence);
        let (parts, residual, joints) = slopes(evidence, &hypothesis, &expected, earlier);
        let objective = objective(&residual, &train, &hypothesis, &expected);
        let (products, of_folds) = products(evidence, &joints, expected.len());
        let normal = Cholesky::new(normal(&products, &expected))?;
        let gradient = gradient(&joints, &residual, &train, &hypothesis, &expected);
        objective.is_finite().then_some(())?;
        let refitted_squares = refitted_squares(&joints, &residual, &-normal.solve(&gradient));
        Some(Self {
            hypothesis,
            expected,
            residual,
            objective,
            parts: parts.into(),
            joints: joints.into(),
            gradient,
            products,
            of_folds,
            normal,
            refitted_squares,
            train,
        })
    }

    /// The same without what only a search for one more effect needs, and which takes most memory.
    pub fn without_parts(self) -> Self {
        Self { parts: Arc::from([]), ..self }
    }

    /// The same slopes about a model near by, with what it leaves.
    pub fn moved_to(&self, hypothesis: Hypothesis, residual: Rows, objective: f64) -> Self {
        let gradient = gradient(&self.joints, &residual, &self.train, &hypothesis, &self.expected);
        Self { hypothesis, residual, objective, gradient, ..self.clone() }
    }

    /// The same model and slopes on rows with other weights; `None` where the numbers do not work
    /// out.
    pub fn reweighted(&self, from: &Evidence, to: &Evidence) -> Option<Self> {
        let ratios: Vec<Vec<f64>> =
            (0..from.joint_count()).map(|joint| from.ratios_to(to, joint).collect()).collect();
        let mut residual = self.residual.clone();
        for (rows, ratios) in residual.iter_mut().zip(&ratios) {
            rows.iter_mut().zip(ratios).for_each(|(row, ratio)| *row *= ratio);
        }
        let joints: Vec<JointSlopes> =
            self.joints.par_iter().map(|slopes| slopes.scaled(&ratios[slopes.joint])).collect();
        let objective = objective(&residual, &self.train, &self.hypothesis, &self.expected);
        let (products, of_folds) = products(to, &joints, self.expected.len());
        let gradient = gradient(&joints, &residual, &self.train, &self.hypothesis, &self.expected);
        let normal = Cholesky::new(normal(&products, &self.expected))?;
        let refitted_squares = refitted_squares(&joints, &residual, &-normal.solve(&gradient));
        let joints = joints.into();
        Some(Self {
            residual,
            objective,
            refitted_squares,
            products,
            of_folds,
            normal,
            gradient,
            joints,
            ..self.clone()
        })
    }

    /// The same model and slopes where something else is known of what is open; `None` where the
    /// numbers do not work out.
    pub fn with_known(&self, expected: Vec<Expected>) -> Option<Self> {
        let Self { residual, hypothesis, train, .. } = self;
        let objective = objective(residual, train, hypothesis, &expected);
        let normal = Cholesky::new(normal(&self.products, &expected))?;
        let gradient = gradient(&self.joints, residual, train, hypothesis, &expected);
        Some(Self { expected, objective, normal, gradient, ..self.clone() })
    }

    /// Squares of the prior penalty: deviations of what is open from what is known of it.
    pub fn prior_penalty(&self) -> f64 {
        self.expected.iter().map(|e| self.squared_deviation(e)).sum()
    }

    /// Those of parameters that are not another joint's own than this one's (from 0).
    pub fn prior_penalty_on(&self, joint: usize) -> f64 {
        let is_here = |e: &&Expected| e.unknown.own_joint().is_none_or(|own| own == joint);
        self.expected.iter().filter(is_here).map(|e| self.squared_deviation(e)).sum()
    }

    fn squared_deviation(&self, e: &Expected) -> f64 {
        ((e.unknown.get(&self.hypothesis) - e.mean) / e.deviation).powi(2)
    }

    /// The matrix whose Cholesky factors solve for a step.
    pub(super) fn normal(&self) -> DMatrix<f64> {
        normal(&self.products, &self.expected)
    }

    /// Rows of a joint that belong to train logs.
    pub fn train_rows(&self, joint: usize) -> usize {
        self.train[joint]
    }

    /// The lower factor L of the inverse L L^T of the covariance of all that is open.
    pub fn factor(&self) -> DMatrix<f64> {
        self.normal.l()
    }

    /// Place of a parameter among what is open.
    pub fn place_of(&self, unknown: Unknown) -> Option<usize> {
        self.expected.iter().position(|expected| expected.unknown == unknown)
    }

    /// Standard deviation of an open parameter, for residuals that are noise alone.
    pub fn deviation(&self, place: usize) -> f64 {
        let mut unit = DVector::zeros(self.expected.len());
        unit[place] = 1.0;
        self.normal.solve(&unit)[place].max(0.0).sqrt()
    }
}

/// Products of the slopes over all train rows, and over those of each fold.
fn products(
    evidence: &Evidence,
    joints: &[JointSlopes],
    open: usize,
) -> (Arc<DMatrix<f64>>, Arc<[DMatrix<f64>]>) {
    let runs: Vec<_> = joints.iter().map(|own| gram::runs(&evidence.folds(own.joint))).collect();
    let of_folds = gram::by_groups(joints, &runs, evidence.criteria.selection.folds, open);
    let all = of_folds.iter().fold(DMatrix::zeros(open, open), |sum, fold| sum + fold);
    (all.into(), of_folds.into())
}

#[cfg(test)]
mod tests {
    use model::reference_robot::reference_robot;
    use rig::Plant;

    use super::*;
    use crate::criteria::Criteria;
    use crate::trial::test_stretch::rows_of_sines;

    #[test]
    fn a_model_on_rows_of_other_weights_is_as_if_linearised_there() {
        let from = rows_of_sines(&Criteria::default());
        let hypothesis = Hypothesis::bare(Plant::of_robot(&reference_robot()));
        let open: Vec<Expected> = (0..6)
            .map(|k| Expected::new(Unknown::Base(k), hypothesis.plant.base(k), 0.1))
            .collect();
        let weight = |joint: usize, k: usize| 3.0 + joint as f64 + (0.01 * k as f64).sin();
        let to = from.with_train_weights(|joint, s| {
            (0..from.row_count(joint, s)).map(|k| weight(joint, k)).collect()
        });
        let of = |evidence: &Evidence| {
            Linearisation::of(evidence, hypothesis.clone(), open.clone()).unwrap()
        };
        let (there, moved) = (of(&to), of(&from).reweighted(&from, &to).unwrap());
        let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-9, "{a} rather than {b}");
        near(moved.objective, there.objective);
        near(moved.squares(), there.squares());
        near(moved.refitted_objective(), there.refitted_objective());
    }
}
