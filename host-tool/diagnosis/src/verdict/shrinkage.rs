//! How much of the gap a cause takes away on the logs held out, and how sure that is.

use rand_distr::{Distribution, Uniform};
use rand_pcg::Pcg64Mcg;

use crate::rows::evidence::{Evidence, Rows};
use crate::rows::noise::NoiseByRate;
use files::Role;

/// 1 - rms with / rms without, with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shrinkage {
    /// The value.
    pub value: f64,
    /// Its 95 % interval.
    pub interval: [f64; 2],
}

/// Squares of a piece of rows without and with the cause [V^2].
type Piece = (f64, f64);

impl Shrinkage {
    /// Of the residuals without and with a cause, over some joints.
    pub fn of(evidence: &Evidence, joints: &[usize], without: &Rows, with: &Rows) -> Self {
        let pieces = pieces(evidence, joints, without, with);
        let draw_count = evidence.criteria.verdict.shrinkage_draws;
        let mut random = Pcg64Mcg::new(1);
        let Ok(any) = Uniform::new(0, pieces.len()) else {
            return Self { value: 0.0, interval: [0.0; 2] };
        };
        let mut draws: Vec<f64> = (0..draw_count)
            .map(|_| {
                let draw = |_| pieces[any.sample(&mut random)];
                shrinkage((0..pieces.len()).map(draw))
            })
            .collect();
        draws.sort_by(f64::total_cmp);
        let quantile = |part: f64| draws[(part * (draw_count - 1) as f64).round() as usize];
        Self {
            value: shrinkage(pieces.iter().copied()),
            interval: [quantile(0.025), quantile(0.975)],
        }
    }
}

fn shrinkage(pieces: impl Iterator<Item = Piece>) -> f64 {
    let (without, with) = pieces.fold((0.0, 0.0), |sum, piece| (sum.0 + piece.0, sum.1 + piece.1));
    if without > 0.0 { 1.0 - (with / without).sqrt() } else { 0.0 }
}

fn pieces(evidence: &Evidence, joints: &[usize], without: &Rows, with: &Rows) -> Vec<Piece> {
    let piece_s = evidence.criteria.verdict.shrinkage_piece_s;
    let mut pieces = Vec::new();
    for &joint in joints {
        for (s, range) in evidence.ranges(joint).into_iter().enumerate() {
            if evidence.stretches[s].role != Role::Holdout {
                continue;
            }
            let unit = evidence.floor_v(joint, s).powi(2);
            let length = (piece_s / evidence.filter(joint, s).row_period_s()).ceil() as usize;
            let squares = |rows: &[f64]| unit * rows.iter().map(|row| row * row).sum::<f64>();
            let both = without[joint][range.clone()].chunks(length);
            pieces.extend(
                both.zip(with[joint][range].chunks(length)).map(|(a, b)| (squares(a), squares(b))),
            );
        }
    }
    pieces
}

/// Root mean square of each joint's rows held out [V].
pub fn held_out_rms_v(evidence: &Evidence, rows: &Rows) -> Vec<f64> {
    let of_joint = |&joint: &usize| {
        let (mut squares, mut count) = (0.0, 0);
        for (s, range) in evidence.ranges(joint).into_iter().enumerate() {
            if evidence.stretches[s].role == Role::Holdout {
                let unit = evidence.floor_v(joint, s).powi(2);
                squares += unit * rows[joint][range.clone()].iter().map(|r| r * r).sum::<f64>();
                count += range.len();
            }
        }
        (squares / f64::from(count.max(1) as u32)).sqrt()
    };
    evidence.joints.iter().map(of_joint).collect()
}

/// What noise alone would leave of each joint's rows held out, rms [V].
pub fn held_out_floor_v(evidence: &Evidence, noise: &NoiseByRate) -> Vec<f64> {
    let one: Rows = [0, 1, 2].map(|joint| {
        let share = |(s, range): (usize, std::ops::Range<usize>)| {
            let floor = noise_floor_v(evidence, noise, joint, s) / evidence.floor_v(joint, s);
            vec![floor; range.len()]
        };
        evidence.ranges(joint).into_iter().enumerate().flat_map(share).collect()
    });
    held_out_rms_v(evidence, &one)
}

/// What noise would leave of a joint's rows in a stretch, rms [V].
pub fn noise_floor_v(evidence: &Evidence, noise: &NoiseByRate, joint: usize, s: usize) -> f64 {
    let filter = evidence.filter(joint, s);
    let period_s = evidence.stretches[s].period_s;
    noise.of(joint, period_s).behind(|f| filter.gain(f), period_s)
}
