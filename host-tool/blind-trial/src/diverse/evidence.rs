//! What the logs of a twin leave of the command under the true model, refitted: how much of it
//! speaks for a cause.

use model::base::COUNT;
use nalgebra::{DMatrix, DVector};

use crate::case::{Case, Recorded};
use crate::detectability::{Group, Residuals};
use crate::error::TrialError;
use crate::plans::is_train;
use crate::reality::ModelError;
use rig::Plan;

/// Correlations below this are taken for none.
const LEAST_CORRELATION: f64 = 0.05;

/// What a twin leaves on the logs to train on and on those held out.
pub struct Evidence {
    train: Vec<Group>,
    held_out: Vec<Group>,
}

/// How rows weigh: as noise, what causes aside is left of a robot, with its memory.
pub struct Weights {
    /// Squares of it [V^2], and how many rows are independent, for each group to train on.
    groups: Vec<Weight>,
    /// One over the variance of each refitted parameter.
    prior: DVector<f64>,
}

#[derive(Clone, Copy, Debug)]
struct Weight {
    square_v2: f64,
    rows: f64,
}

/// A refit and what it leaves.
pub struct Refit {
    change: DVector<f64>,
    /// Mean squares of each group to train on [V^2].
    squares_v2: Vec<f64>,
    /// Squares of the changes, in variances of the model as given.
    penalty: f64,
}

impl Evidence {
    /// Of a recording that clock and bus have not touched.
    ///
    /// # Errors
    /// A log too short to be judged.
    pub fn of(case: &Case, recorded: &[Recorded]) -> Result<Self, TrialError> {
        let groups = |wanted: fn(&Plan) -> bool| {
            let groups = Residuals::of_logs(case, recorded, wanted)?.groups;
            Ok::<_, TrialError>(groups.into_iter().map(with_torque_constants).collect())
        };
        Ok(Self { train: groups(is_train)?, held_out: groups(|plan| !is_train(plan))? })
    }

    /// What it leaves more than another of the same motions, row by row.
    pub fn less(self, other: &Self) -> Self {
        let less = |groups: Vec<Group>, others: &[Group]| {
            groups.into_iter().zip(others).map(|(group, other)| difference(group, other)).collect()
        };
        Self {
            train: less(self.train, &other.train),
            held_out: less(self.held_out, &other.held_out),
        }
    }

    /// A refit of the parameters to the logs to train on.
    pub fn refit(&self, weights: &Weights) -> Refit {
        let count = weights.prior.len();
        let mut normal = DMatrix::from_diagonal(&weights.prior);
        let mut right = DVector::zeros(count);
        for (group, weight) in self.train.iter().zip(&weights.groups) {
            let each = weight.each(group.residual_v.len());
            normal += group.columns.tr_mul(&group.columns) * each;
            right += group.columns.tr_mul(&group.residual_v) * each;
        }
        let zero = DVector::zeros(count);
        let change = normal.cholesky().map_or(zero, |cholesky| cholesky.solve(&right));
        Refit {
            squares_v2: self.train.iter().map(|group| mean_square(&left(group, &change))).collect(),
            penalty: change.component_mul(&change).dot(&weights.prior),
            change,
        }
    }

    /// What a refit leaves on the logs held out, summed over the joints (0 to 2) that count [V^2].
    pub fn held_out_v2(&self, refit: &Refit, counts: impl Fn(usize) -> bool) -> f64 {
        let groups = self.held_out.iter().filter(|group| counts(group.joint));
        groups.map(|group| left(group, &refit.change).norm_squared()).sum()
    }
}

impl Weights {
    /// From what a twin without causes leaves. Its rows first count as independent, and then by
    /// the memory that a refit leaves in them.
    pub fn of(twin: &Evidence, error: &ModelError) -> Self {
        let independent = |group: &Group| Weight {
            square_v2: mean_square(&group.residual_v),
            rows: group.residual_v.len() as f64,
        };
        let first =
            Self { groups: twin.train.iter().map(independent).collect(), prior: prior(error) };
        let refit = twin.refit(&first);
        let with_memory = |group: &Group| {
            let left = left(group, &refit.change);
            let rows = left.len() as f64 / memory_rows(&left);
            Weight { square_v2: mean_square(&left), rows }
        };
        Self { groups: twin.train.iter().map(with_memory).collect(), ..first }
    }

    /// Twice the logarithm by which a cause makes the logs more likely that leaves `alone` of the
    /// command, made `part` times as large: sum N ln(S without / S with), where the squares of
    /// the cause come on top of those that the twin leaves with it, and the prior's penalty.
    pub fn gain(&self, alone: &Refit, part: f64) -> f64 {
        let logs = alone.squares_v2.iter().zip(&self.groups).map(|(square_v2, weight)| {
            weight.rows * (part * part * square_v2 / weight.square_v2.max(1e-18)).ln_1p()
        });
        logs.sum::<f64>() + part * part * alone.penalty
    }
}

impl Weight {
    /// The weight of one of so many rows [1/V^2].
    fn each(self, rows: usize) -> f64 {
        self.rows / (rows.max(1) as f64 * self.square_v2.max(1e-18))
    }
}

/// One over the variances of the relative changes; a torque constant that is not off is held.
fn prior(error: &ModelError) -> DVector<f64> {
    let parameters = 1.0 / error.parameters.powi(2);
    let torque_constants = 1.0 / error.torque_constants.max(1e-4).powi(2);
    DVector::from_fn(COUNT + 9, |k, _| if k < COUNT + 6 { parameters } else { torque_constants })
}

/// The group with slopes by the torque constants: what the rigid body needs is k_t's to divide.
fn with_torque_constants(group: Group) -> Group {
    let rigid_v = group.columns.columns(0, COUNT).column_sum();
    let known = group.columns.ncols();
    let mut columns = group.columns.resize_horizontally(known + 3, 0.0);
    columns.set_column(known + group.joint, &-rigid_v);
    Group { columns, ..group }
}

/// Rows count from the end, since a joint's first row is where its friction is known.
fn difference(group: Group, other: &Group) -> Group {
    let rows = group.residual_v.len().min(other.residual_v.len());
    let skipped = group.residual_v.len() - rows;
    let theirs = other.residual_v.rows(other.residual_v.len() - rows, rows);
    Group {
        residual_v: group.residual_v.rows(skipped, rows) - theirs,
        columns: group.columns.rows(skipped, rows).into_owned(),
        ..group
    }
}

fn left(group: &Group, change: &DVector<f64>) -> DVector<f64> {
    &group.residual_v - &group.columns * change
}

fn mean_square(values: &DVector<f64>) -> f64 {
    values.norm_squared() / values.len().max(1) as f64
}

/// How many rows hold as much as one independent row: 1 + 2 sum of the correlations, up to the
/// first that is none.
fn memory_rows(values: &DVector<f64>) -> f64 {
    let whole = values.norm_squared();
    let correlation = |lag: usize| {
        let later = values.rows(lag, values.len() - lag);
        values.rows(0, values.len() - lag).dot(&later) / whole
    };
    let most = values.len() / 4;
    let correlations = (1..most).map(correlation).take_while(|c| *c > LEAST_CORRELATION);
    1.0 + 2.0 * correlations.sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_is_counted() {
        let mut level = 0.0;
        let mut rng = crate::Rng::new(1, 1);
        let kept: f64 = 0.8;
        let values = DVector::from_fn(20_000, |_, _| {
            level = kept * level + rng.normal_within(5.0);
            level
        });
        let expected = (1.0 + kept) / (1.0 - kept);
        assert!((memory_rows(&values) / expected - 1.0).abs() < 0.15, "{}", memory_rows(&values));
    }
}
