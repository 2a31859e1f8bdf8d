//! All rows of a model linearised in what is open, and how well a change of them fits once
//! everything open is refitted.

use std::sync::Arc;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::earlier::Earlier;
use super::gram;
use super::joint_slopes::JointSlopes;
use super::normal_equations::{gradient, normal, objective, refitted_squares, train_rows};
use super::slopes::slopes;
use super::unknowns::{Expected, Unknown};
use crate::rows::evidence::{Evidence, RowChange, Rows};
use crate::trial::hypothesis::{EffectInstance, Hypothesis};
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
    refitted_squares: Vec<f64>,
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
        let ratio = |joint: usize| -> Vec<f64> {
            let both = from.weights(joint).zip(to.weights(joint));
            both.map(|(from, to)| if from > 0.0 { to / from } else { 0.0 }).collect()
        };
        let ratios: Vec<Vec<f64>> = (0..from.joint_count()).map(ratio).collect();
        let mut residual = self.residual.clone();
        for (rows, ratios) in residual.iter_mut().zip(&ratios) {
            rows.iter_mut().zip(ratios).for_each(|(row, ratio)| *row *= ratio);
        }
        let joints: Vec<JointSlopes> =
            self.joints.iter().map(|slopes| slopes.scaled(&ratios[slopes.joint])).collect();
        let objective = objective(&residual, &self.train, &self.hypothesis, &self.expected);
        let (products, of_folds) = products(to, &joints, self.expected.len());
        let gradient = gradient(&joints, &residual, &self.train, &self.hypothesis, &self.expected);
        let normal = Cholesky::new(normal(&products, &self.expected))?;
        let joints = joints.into();
        Some(Self {
            residual,
            objective,
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

    /// The change of what is open that fits best, by the slopes, where each value may go no further
    /// than its range: what would is fixed at its end, and the others are solved for again.
    pub fn step_within(&self, range: impl Fn(Unknown) -> [f64; 2]) -> DVector<f64> {
        let (mut normal, mut gradient) = (self.normal(), self.gradient.clone());
        let mut step = -self.normal.solve(&gradient);
        let mut is_free = vec![true; step.len()];
        loop {
            let mut any = false;
            for (place, expected) in self.expected.iter().enumerate() {
                if !is_free[place] {
                    continue;
                }
                let now = expected.unknown.get(&self.hypothesis);
                let [lowest, highest] = range(expected.unknown);
                let to = (now + step[place]).clamp(lowest.min(now), highest.max(now)) - now;
                if to != step[place] {
                    (is_free[place], any) = (false, true);
                    fix(&mut normal, &mut gradient, place, to);
                }
            }
            match Cholesky::new(normal.clone()) {
                Some(factors) if any => step = -factors.solve(&gradient),
                _ => return step,
            }
        }
    }
    /// By how much a step lowers the objective, by the slopes.
    pub fn gain_of(&self, step: &DVector<f64>) -> f64 {
        -2.0 * self.gradient.dot(step) - step.dot(&(self.normal() * step))
    }

    /// The hypothesis a part of a step further.
    pub fn moved(&self, step: &DVector<f64>, part: f64) -> Hypothesis {
        let mut hypothesis = self.hypothesis.clone();
        for (expected, change) in self.expected.iter().zip(step.iter()) {
            let now = expected.unknown.get(&self.hypothesis);
            expected.unknown.set(&mut hypothesis, now + part * change);
        }
        hypothesis
    }

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

    /// Squares of the prior penalty: deviations of what is open from what is known of it.
    pub fn prior_penalty(&self) -> f64 {
        let squared =
            |e: &Expected| ((e.unknown.get(&self.hypothesis) - e.mean) / e.deviation).powi(2);
        self.expected.iter().map(squared).sum()
    }

    /// The matrix whose Cholesky factors solve for a step.
    pub(super) fn normal(&self) -> DMatrix<f64> {
        normal(&self.products, &self.expected)
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

    /// Rows of a joint that belong to train logs.
    pub fn train_rows(&self, joint: usize) -> usize {
        self.train[joint]
    }

    /// The lower factor L of the inverse L L^T of the covariance of all that is open.
    pub fn factor(&self) -> DMatrix<f64> {
        self.normal.l()
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

/// A joint's rows of a change; none where they do not change.
fn column(change: &RowChange, joint: usize) -> &[f64] {
    change.get(joint).and_then(Option::as_deref).unwrap_or_default()
}

/// Makes a step's value at a place what it is told: by a weight that outweighs all rows.
fn fix(normal: &mut DMatrix<f64>, gradient: &mut DVector<f64>, place: usize, to: f64) {
    let weight = 1e9 * normal[(place, place)];
    normal[(place, place)] += weight;
    gradient[place] -= weight * to;
}
