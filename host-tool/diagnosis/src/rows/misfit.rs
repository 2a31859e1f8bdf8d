//! What a model leaves beyond noise: how large it is and for how long it lasts.
//!
//! What a model leaves of a real machine is not white. It is larger around reversals, where no
//! friction is of anybody's formula, differs from log to log, and neighbouring rows say the same.
//! So a row counts by the square of what is left at its speed in its log, and `correlation` rows
//! count as one: a sum of squares of rows weighted like this is that of as many independent
//! deviations as the logs really hold, and a prior weighs against it what it should.
//!
//! That trusts a log whose rows look white as many times as it has rows, also where they are twice the
//! noise. Where what is left is taken to be systematic (`Evidence::systematic`), a log has no more than
//! `most_systematic_rows` of it, whatever they look like, and only its noise is as white as it looks.

use super::evidence::{Evidence, Rows};
use super::misfit_piece::{NoiseOfRows, Piece, pool};
use super::speed_classes::speed_edges;

/// Size and correlation of what a model leaves of train logs.
#[derive(Clone, Debug)]
pub struct Misfit {
    /// By joint and train stretch.
    pieces: Vec<Vec<Piece>>,
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
            piece.make_as_independent(other);
        }
        self
    }

    /// The same size as if every row said something of its own.
    pub fn independent(mut self) -> Self {
        self.pieces.iter_mut().flatten().for_each(Piece::make_independent);
        self
    }

    /// All rows of a joint of the size that they have together.
    pub fn pooled(mut self) -> Self {
        self.pieces.iter_mut().for_each(|pieces| pool(pieces));
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
            |class: &u8| 1.0 / (piece.square_v2[usize::from(*class)] * piece.rows_as_one()).sqrt();
        piece.class.iter().map(of_class)
    }

    /// Log-likelihood of residuals in volts whose size is free in each class of each log, rows
    /// counted as independent as in this misfit; `gain` tells, by train stretch and joint, in
    /// which unit they count.
    pub fn log_likelihood(&self, evidence: &Evidence, residual_v: &Rows, gain: &[Vec<f64>]) -> f64 {
        let of_joint = |&joint: &usize| self.log_likelihood_of(joint, evidence, residual_v, gain);
        evidence.joints.iter().map(of_joint).sum()
    }

    /// The same of one joint's (from 0).
    pub fn log_likelihood_of(
        &self,
        joint: usize,
        evidence: &Evidence,
        residual_v: &Rows,
        gain: &[Vec<f64>],
    ) -> f64 {
        let ranges = evidence.ranges(joint).into_iter();
        let pieces = self.pieces[joint].iter().zip(ranges).enumerate();
        let of_piece = |(s, (piece, range)): (usize, (&Piece, std::ops::Range<usize>))| {
            let noise = NoiseOfRows {
                square_v2: evidence.floor_v(joint, s).powi(2),
                own_part: evidence.criteria.fit.own_ratio.powi(2),
            };
            piece.log_likelihood(noise, &residual_v[joint][range], gain[s][joint])
        };
        pieces.map(of_piece).sum()
    }
}
