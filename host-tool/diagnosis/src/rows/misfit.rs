//! What a model leaves beyond noise: how large it is and for how long it lasts.
//!
//! What a model leaves of a real machine is not white. It is larger around reversals, where no
//! friction is of anybody's formula, differs from log to log, and neighbouring rows say the same.
//! So a row counts by the square of what is left at its speed in its log, and `correlation` rows
//! count as one: a sum of squares of rows weighted like this is that of as many independent
//! deviations as the logs really hold, and a prior weighs against it what it should.

use super::evidence::{Evidence, Rows};
use crate::criteria::RowCriteria;

/// Size and correlation of what a model leaves of train logs.
#[derive(Clone, Debug)]
pub struct Misfit {
    /// By joint and train stretch.
    pieces: Vec<Vec<Piece>>,
}

/// What is left of one joint in one stretch.
#[derive(Clone, Debug, Default)]
struct Piece {
    /// Class of speed of every row.
    class: Vec<u8>,
    /// Mean square by class [V^2].
    square_v2: Vec<f64>,
    /// Rows with weight, by class.
    count: Vec<f64>,
    /// How many neighbouring rows say the same, at least 1.
    correlation: f64,
}

impl Misfit {
    /// That of residuals in volts, rows of all logs.
    pub fn of(evidence: &Evidence, residual_v: &Rows) -> Self {
        let of_joint = |joint: usize| {
            let edges = speed_edges(evidence, joint);
            let ranges = evidence.ranges(joint).into_iter().take(evidence.train_stretches());
            let piece = |(s, range): (usize, std::ops::Range<usize>)| {
                Piece::of(evidence, joint, s, &residual_v[joint][range], &edges)
            };
            match evidence.joints.contains(&joint) {
                true => ranges.enumerate().map(piece).collect(),
                false => Vec::new(),
            }
        };
        Self { pieces: (0..evidence.joint_count()).map(of_joint).collect() }
    }

    /// The same size with rows as independent as in this one or another, whichever is more.
    pub fn at_least_as_independent(mut self, other: &Self) -> Self {
        let own = self.pieces.iter_mut().flatten();
        for (piece, other) in own.zip(other.pieces.iter().flatten()) {
            piece.correlation = piece.correlation.min(other.correlation);
        }
        self
    }

    /// The same size as if every row said something of its own.
    pub fn independent(mut self) -> Self {
        self.pieces.iter_mut().flatten().for_each(|piece| piece.correlation = 1.0);
        self
    }

    /// The most neighbouring rows of a joint in a log that say the same.
    pub fn longest_correlation(&self) -> f64 {
        self.pieces.iter().flatten().map(|piece| piece.correlation).fold(1.0, f64::max)
    }

    /// Rows weighted by this misfit.
    pub fn weigh(&self, evidence: &Evidence) -> Evidence {
        evidence.with_train_weights(|joint, s| self.weights(joint, s).collect())
    }

    /// Weights of a joint's rows in a train stretch [1/V].
    fn weights(&self, joint: usize, s: usize) -> impl Iterator<Item = f64> {
        let piece = &self.pieces[joint][s];
        let of_class =
            |class: &u8| 1.0 / (piece.square_v2[usize::from(*class)] * piece.correlation).sqrt();
        piece.class.iter().map(of_class)
    }

    /// Log-likelihood of residuals in volts whose size is free in each class of each log, rows
    /// counted as independent as in this misfit; `gain` tells, by train stretch and joint, in
    /// which unit they count.
    pub fn log_likelihood(&self, evidence: &Evidence, residual_v: &Rows, gain: &[Vec<f64>]) -> f64 {
        let of_joint = |&joint: &usize| -> f64 {
            let ranges = evidence.ranges(joint).into_iter();
            let pieces = self.pieces[joint].iter().zip(ranges).enumerate();
            pieces
                .map(|(s, (piece, range))| {
                    let noise = NoiseOfRows {
                        square_v2: evidence.floor_v(joint, s).powi(2),
                        own_part: evidence.criteria.fit.own_ratio.powi(2),
                    };
                    piece.log_likelihood(noise, &residual_v[joint][range], gain[s][joint])
                })
                .sum()
        };
        evidence.joints.iter().map(of_joint).sum()
    }
}

impl Piece {
    fn of(evidence: &Evidence, joint: usize, s: usize, residual_v: &[f64], edges: &[f64]) -> Self {
        let criteria = &evidence.criteria.rows;
        let floor_v2 = evidence.floor_v(joint, s).powi(2);
        let class = classes(evidence, joint, s, edges);
        let mut piece = Self { class, correlation: 1.0, ..Self::default() };
        let (sums, count) = piece.sums(residual_v, edges.len() + 1);
        let whole: f64 = sums.iter().sum::<f64>() / count.iter().sum::<f64>().max(1.0);
        let pooled = criteria.pooled_rows;
        let square =
            |(sum, count): (&f64, &f64)| ((sum + pooled * whole) / (count + pooled)).max(floor_v2);
        piece.square_v2 = sums.iter().zip(&count).map(square).collect();
        piece.count = count;
        piece.correlation = correlation(&piece.whitened(residual_v), criteria);
        piece
    }

    /// Squares and rows with weight, by class. Rows that are exactly zero have none.
    fn sums(&self, residual_v: &[f64], classes: usize) -> (Vec<f64>, Vec<f64>) {
        let (mut sums, mut count) = (vec![0.0; classes], vec![0.0; classes]);
        for (&class, &row) in self.class.iter().zip(residual_v).filter(|(_, row)| **row != 0.0) {
            sums[usize::from(class)] += row * row;
            count[usize::from(class)] += 1.0;
        }
        (sums, count)
    }

    fn whitened(&self, residual_v: &[f64]) -> Vec<f64> {
        let unit = |class: &u8| self.square_v2[usize::from(*class)].sqrt();
        residual_v.iter().zip(&self.class).map(|(row, class)| row / unit(class)).collect()
    }

    fn log_likelihood(&self, noise: NoiseOfRows, residual_v: &[f64], gain: f64) -> f64 {
        let (sums, count) = self.sums(residual_v, self.square_v2.len());
        let of_class = |(sum, count): (&f64, &f64)| {
            let square_v2 = noise.as_sent(sum / count.max(1.0), gain);
            -0.5 * count / self.correlation * square_v2.ln()
        };
        sums.iter().zip(&count).map(of_class).sum()
    }
}

/// Noise of rows.
#[derive(Clone, Copy, Debug)]
struct NoiseOfRows {
    /// Its mean square [V^2].
    square_v2: f64,
    /// Squares up to so many times that are the method's own, and grow as noise does.
    own_part: f64,
}

impl NoiseOfRows {
    /// A mean square of rows [V^2] of which `gain` of every command reaches the motor, in volts of the command
    /// as it was sent, and at least noise. Whatever takes a part of the command takes that part of what is
    /// left, too; what adds to it adds to the noise, and explains nothing of the rest by that.
    fn as_sent(self, square_v2: f64, gain: f64) -> f64 {
        let unit = gain.powi(2).max(1e-12);
        let added_v2 = self.own_part * self.square_v2 * (unit - 1.0).max(0.0);
        (square_v2 / unit).max(square_v2 - added_v2).max(self.square_v2)
    }
}

/// Speeds that part the train rows of a joint into classes of equal size [rad/s].
fn speed_edges(evidence: &Evidence, joint: usize) -> Vec<f64> {
    let mut speeds: Vec<f64> = (0..evidence.train_stretches())
        .flat_map(|s| row_speeds(evidence, joint, s).collect::<Vec<f64>>())
        .collect();
    if speeds.is_empty() {
        return Vec::new();
    }
    speeds.sort_unstable_by(f64::total_cmp);
    let last = (speeds.len() - 1) as f64;
    evidence.criteria.rows.speed_classes.iter().map(|part| speeds[(part * last) as usize]).collect()
}

fn classes(evidence: &Evidence, joint: usize, s: usize, edges: &[f64]) -> Vec<u8> {
    let class = |speed: f64| edges.iter().filter(|edge| speed > **edge).count() as u8;
    row_speeds(evidence, joint, s).map(class).collect()
}

fn row_speeds(evidence: &Evidence, joint: usize, s: usize) -> impl Iterator<Item = f64> {
    let stretch = &evidence.stretches[s];
    let instants = evidence.filter(joint, s).instants(stretch.len());
    instants.map(move |k| stretch.motion.qd_rad_per_s[joint][k].abs())
}

/// How many neighbouring rows count as one: 1 + 2 times the sum of the autocorrelation up to where
/// it first vanishes.
fn correlation(rows: &[f64], criteria: &RowCriteria) -> f64 {
    let product = |lag: usize| -> f64 { rows.iter().zip(&rows[lag..]).map(|(a, b)| a * b).sum() };
    let most = (rows.len() / criteria.fewest_independent_rows.max(1)).max(1);
    let square = product(0).max(f64::MIN_POSITIVE);
    let positive = (1..most).map(|lag| product(lag) / square).take_while(|part| *part > 0.0);
    1.0 + 2.0 * positive.sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_motor_that_gets_more_or_less_of_the_command_neither_gains_nor_loses_by_its_noise() {
        for gain in [0.5, 0.93, 1.0, 1.07, 2.0] {
            let noise = NoiseOfRows { square_v2: 4e-6, own_part: 2.25 };
            let sent = |times: f64| noise.as_sent(times * noise.square_v2, gain) / noise.square_v2;
            assert!((sent(gain * gain) - 1.0).abs() < 1e-9, "{gain}");
            assert!(sent(100.0) > 90.0, "{gain}");
            assert!(sent(0.1) >= 1.0, "{gain}");
        }
    }
}
