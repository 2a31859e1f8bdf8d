//! Where the knots of a table lie.

use crate::rows::evidence::Evidence;
use crate::trial::equation::Trial;
use crate::trial::hypothesis::Hypothesis;
use rig::effects::{Table, TableAxis};

/// Speeds, as parts of the samples below them, at which a table over velocity has knots, in both
/// directions: friction bends most where it is slow.
const SPEEDS: [f64; 8] = [0.02, 0.05, 0.1, 0.2, 0.4, 0.65, 0.9, 0.995];
/// Parts of the samples below the knots of a table over load or command.
const LEVELS: [f64; 11] = [0.005, 0.03, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.97, 0.995];
/// Knots, evenly spaced, of a table over position, and of one over time.
const OVER_POSITION: usize = 21;
const OVER_TIME: usize = 9;
/// Knots closer than this part of their range are one.
const CLOSEST: f64 = 1e-3;
/// The knots follow from every so many samples.
const EVERY: usize = 10;

/// A table of zeros over an axis of a joint (0 to 2), where train logs have data; none where they
/// have too little.
pub fn flat(
    evidence: &Evidence,
    hypothesis: &Hypothesis,
    joint: usize,
    axis: TableAxis,
) -> Option<Table> {
    let mut x: Vec<f64> = evidence.stretches[..evidence.train_stretches()]
        .iter()
        .flat_map(|stretch| {
            let trial = Trial::of(stretch, hypothesis, &evidence.criteria.fit);
            trial.abscissa(joint, axis).into_iter().step_by(EVERY)
        })
        .collect();
    x.sort_unstable_by(f64::total_cmp);
    let knots = apart(knots(axis, &x)?);
    let enough = knots.len() > 2;
    let values_v = vec![0.0; knots.len()];
    enough.then(|| Table { joint: joint as u8 + 1, axis, knots, values_v })
}

fn knots(axis: TableAxis, sorted: &[f64]) -> Option<Vec<f64>> {
    let (first, last) = (quantile(sorted, 0.005)?, quantile(sorted, 0.995)?);
    let even = |count: usize| -> Vec<f64> {
        (0..count).map(|k| first + (last - first) * k as f64 / (count - 1) as f64).collect()
    };
    Some(match axis {
        TableAxis::Position => even(OVER_POSITION),
        TableAxis::Time => even(OVER_TIME),
        TableAxis::Velocity => over_velocity(sorted)?,
        TableAxis::Load | TableAxis::Command => {
            LEVELS.iter().filter_map(|level| quantile(sorted, *level)).collect()
        }
    })
}

/// Knots in both directions, and at standstill.
fn over_velocity(sorted: &[f64]) -> Option<Vec<f64>> {
    let mut speeds: Vec<f64> = sorted.iter().map(|v| v.abs()).collect();
    speeds.sort_unstable_by(f64::total_cmp);
    let levels = SPEEDS.iter().filter_map(|level| quantile(&speeds, *level));
    let mut knots: Vec<f64> = levels.flat_map(|speed| [-speed, speed]).chain([0.0]).collect();
    knots.sort_unstable_by(f64::total_cmp);
    (*speeds.last()? > 0.0).then_some(knots)
}

/// The value that so much of some sorted ones stays below; none of none.
pub fn quantile(sorted: &[f64], part: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    sorted.get((part * last as f64).round() as usize).copied()
}

/// Knots without those that are closer to the one before than a small part of their range.
fn apart(knots: Vec<f64>) -> Vec<f64> {
    let range = knots.last().copied().unwrap_or(0.0) - knots.first().copied().unwrap_or(0.0);
    let mut kept: Vec<f64> = Vec::new();
    for knot in knots {
        if kept.last().is_none_or(|last| knot - last > CLOSEST * range) {
            kept.push(knot);
        }
    }
    kept
}
