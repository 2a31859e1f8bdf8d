//! All rows of a model linearised in what is open, and how well a change of them fits once
//! everything open is refitted.

use std::ops::Range;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::slopes::{JointSlopes, changed, slopes};
use super::unknowns::Expected;
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
    /// Residuals of all joints, in units of noise.
    pub residual: Rows,
    /// Squares of train rows and of the prior penalty.
    pub objective: f64,
    /// What the model's equation consists of, stretch by stretch, joint by joint.
    parts: Vec<[Parts; 3]>,
    joints: Vec<JointSlopes>,
    /// Half the gradient of the objective.
    gradient: DVector<f64>,
    normal: Cholesky<f64, Dyn>,
    train: [usize; 3],
}

/// How well a change of the rows fits, everything open refitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Score {
    /// Squares of train rows and of prior penalty.
    pub train: f64,
    /// Squares of the rows held out.
    pub holdout: f64,
}

impl Score {
    /// Both together.
    pub fn total(&self) -> f64 {
        self.train + self.holdout
    }
}

impl Linearisation {
    /// Linearises a model; `expected` must name its effects' parameters too.
    /// `None` where the numbers do not work out.
    pub fn of(
        evidence: &Evidence,
        hypothesis: Hypothesis,
        expected: Vec<Expected>,
    ) -> Option<Self> {
        let train = [0, 1, 2].map(|joint| evidence.train_rows(joint));
        let (parts, residual, joints) = slopes(evidence, &hypothesis, &expected);
        let objective = objective(&residual, &train, &hypothesis, &expected);
        let (normal, gradient) =
            normal_equations(&joints, &residual, &train, &hypothesis, &expected);
        let normal = Cholesky::new(normal)?;
        objective.is_finite().then_some(())?;
        Some(Self {
            hypothesis,
            expected,
            residual,
            objective,
            parts,
            joints,
            gradient,
            normal,
            train,
        })
    }

    /// The change of what is open that fits best, by the slopes.
    pub fn step(&self) -> DVector<f64> {
        -self.normal.solve(&self.gradient)
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

    /// The score of the model as it stands, refitted by the slopes.
    pub fn score(&self) -> Score {
        self.score_of(&RowChange::default())
    }

    /// The score once all rows change so.
    pub fn score_of(&self, change: &RowChange) -> Score {
        let (step, train) = self.refitted(change);
        Score { train, holdout: self.left_held_out(change, &step) }
    }

    /// Squares of train rows and of the prior penalty once train rows change so.
    pub fn train_score_of(&self, change: &RowChange) -> f64 {
        self.refitted(change).1
    }

    /// The step of what is open that fits best once train rows change so, and the train score
    /// after it.
    fn refitted(&self, change: &RowChange) -> (DVector<f64>, f64) {
        let gradient = &self.gradient + self.against(change);
        let step = -self.normal.solve(&gradient);
        let mut train = self.objective + gradient.dot(&step);
        for joint in [0, 1, 2] {
            let both = column(change, joint).iter().zip(&self.residual[joint]);
            train += both.take(self.train[joint]).map(|(c, r)| c * (c + 2.0 * r)).sum::<f64>();
        }
        (step, train)
    }

    /// Squares of the rows held out after a change of rows and a step.
    fn left_held_out(&self, change: &RowChange, step: &DVector<f64>) -> f64 {
        let of_joint = |slopes: &JointSlopes| {
            let (joint, first) = (slopes.joint, self.train[slopes.joint]);
            let held = slopes.matrix.rows_range(first..);
            let own = DVector::from_iterator(
                slopes.places.len(),
                slopes.places.iter().map(|&place| step[place]),
            );
            let mut left = held * own;
            for (k, value) in left.iter_mut().enumerate() {
                *value += self.residual[joint][first + k];
                *value += change[joint].as_ref().map_or(0.0, |column| column[first + k]);
            }
            left.norm_squared()
        };
        self.joints.iter().map(of_joint).sum()
    }

    /// Slopes' products with a change of the train rows.
    fn against(&self, change: &RowChange) -> DVector<f64> {
        let mut sum = DVector::zeros(self.expected.len());
        for slopes in &self.joints {
            let Some(column) = &change[slopes.joint] else { continue };
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
            (0..3).map(|joint| product(joint, column(a, joint), column(b, joint))).sum()
        };
        let with_residual = |a: &RowChange| -> f64 {
            (0..3).map(|joint| product(joint, column(a, joint), &self.residual[joint])).sum()
        };
        let half_gradient = DVector::from_fn(count, |i, _| {
            with_residual(&slopes[i]) + of_changes(&slopes[i], about) - solved[i].dot(&gradient)
        });
        let curvature = DMatrix::from_fn(count, count, |i, k| {
            of_changes(&slopes[i], &slopes[k]) - against[i].dot(&solved[k])
        });
        (half_gradient, curvature)
    }

    /// Change of rows by one more effect; `all_joints` or just that of its own joint.
    pub fn change_by(
        &self,
        evidence: &Evidence,
        effect: &EffectInstance,
        which: Which,
    ) -> RowChange {
        let own = usize::from(effect.joint).checked_sub(1);
        let joints = match own.filter(|_| !effect.definition.couples_joints || !which.joints) {
            None => evidence.joints.clone(),
            Some(own) => vec![own],
        };
        let others = &self.hypothesis.effects;
        let hypothesis = self.hypothesis.with(effect.clone());
        let count =
            if which.held_out { evidence.stretches.len() } else { evidence.train_stretches() };
        let mut change = RowChange::default();
        for (s, parts) in self.parts.iter().enumerate().take(count) {
            changed(evidence, s, parts, &hypothesis, (effect, others), &joints, &mut change);
        }
        change
    }

    /// Rows of a joint that belong to train logs.
    pub fn train_rows(&self, joint: usize) -> usize {
        self.train[joint]
    }

    /// Squares that a joint's rows in `range` are expected to have beyond noise, because what
    /// is open is known no better than the train logs tell: the trace of J P J'.
    pub fn spread(&self, joint: usize, range: Range<usize>) -> f64 {
        let Some(slopes) = self.joints.iter().find(|slopes| slopes.joint == joint) else {
            return 0.0;
        };
        let rows = slopes.matrix.rows_range(range);
        let products = rows.tr_mul(&rows);
        let mut unit = DMatrix::zeros(self.expected.len(), slopes.places.len());
        slopes.places.iter().enumerate().for_each(|(k, &place)| unit[(place, k)] = 1.0);
        let covariance = unit.tr_mul(&self.normal.solve(&unit));
        covariance.component_mul(&products).sum()
    }

    /// Standard deviation of an open parameter, for residuals that are noise alone.
    pub fn deviation(&self, place: usize) -> f64 {
        let mut unit = DVector::zeros(self.expected.len());
        unit[place] = 1.0;
        self.normal.solve(&unit)[place].max(0.0).sqrt()
    }
}

/// A joint's rows of a change; none where they do not change.
fn column(change: &RowChange, joint: usize) -> &[f64] {
    change[joint].as_deref().unwrap_or_default()
}

/// Which rows of a change are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Which {
    /// Those of joints that the effect does not act on, too.
    pub joints: bool,
    /// Those held out, too.
    pub held_out: bool,
}

impl Which {
    /// All rows.
    pub const ALL: Self = Self { joints: true, held_out: true };
    /// Train rows.
    pub const TRAIN: Self = Self { joints: true, held_out: false };
    /// Train rows of the effect's own joint.
    pub const OWN: Self = Self { joints: false, held_out: false };
}

/// Squares of train rows and of the prior penalty.
pub fn objective(
    residual: &Rows,
    train: &[usize; 3],
    hypothesis: &Hypothesis,
    expected: &[Expected],
) -> f64 {
    let rows: f64 = (0..3).flat_map(|j| residual[j].iter().take(train[j])).map(|r| r * r).sum();
    let prior_penalty: f64 =
        expected.iter().map(|e| ((e.unknown.get(hypothesis) - e.mean) / e.deviation).powi(2)).sum();
    rows + prior_penalty
}

fn normal_equations(
    joints: &[JointSlopes],
    residual: &Rows,
    train: &[usize; 3],
    hypothesis: &Hypothesis,
    expected: &[Expected],
) -> (DMatrix<f64>, DVector<f64>) {
    let count = expected.len();
    let mut normal = DMatrix::zeros(count, count);
    let mut gradient = DVector::zeros(count);
    for (place, e) in expected.iter().enumerate() {
        let weight = e.deviation.powi(-2);
        normal[(place, place)] += weight;
        gradient[place] += weight * (e.unknown.get(hypothesis) - e.mean);
    }
    for slopes in joints {
        let rows = train[slopes.joint];
        let matrix = slopes.matrix.rows_range(..rows);
        let products = matrix.tr_mul(&matrix);
        let right = nalgebra::DVectorView::from_slice(&residual[slopes.joint][..rows], rows);
        let own = matrix.tr_mul(&right);
        for (a, &place_a) in slopes.places.iter().enumerate() {
            gradient[place_a] += own[a];
            for (b, &place_b) in slopes.places.iter().enumerate() {
                normal[(place_a, place_b)] += products[(a, b)];
            }
        }
    }
    (normal, gradient)
}
