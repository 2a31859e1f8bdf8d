//! The warmth of joints in logs that are held out: it is the log's own, as what bristles are bent by is, and no fit to
//! other logs tells it.

use std::borrow::Cow;

use nalgebra::{Matrix2, Vector2};
use rayon::prelude::*;

use super::equation::Trial;
use super::hypothesis::Hypothesis;
use super::warmth::{Warmth, Warmths};
use crate::logs::intervals::at_samples;
use crate::rows::evidence::Evidence;

/// The most that the warmth of a log which is held out may be off, in deviations of what is known of it.
const MOST_DEVIATIONS: f64 = 3.0;

/// A hypothesis with the warmth that held-out logs tell, where it has one in train logs: least squares of each joint's
/// rows in each log, by what is known of warmth beforehand. A log of which a part trains has its warmth already.
pub fn with_held_warmth<'a>(
    evidence: &Evidence,
    hypothesis: &'a Hypothesis,
) -> Cow<'a, Hypothesis> {
    if hypothesis.warmths.is_empty() {
        return Cow::Borrowed(hypothesis);
    }
    let (train, held) = evidence.stretches.split_at(evidence.train_stretches());
    let mut logs: Vec<usize> = held.iter().map(|stretch| stretch.log).collect();
    logs.sort_unstable();
    logs.dedup();
    logs.retain(|log| train.iter().all(|stretch| stretch.log != *log));
    let of_logs = logs.into_par_iter().map(|log| warmths_in(evidence, hypothesis, log));
    let mut with = hypothesis.clone();
    with.warmths.extend(of_logs.collect::<Vec<Warmths>>().into_iter().flatten());
    Cow::Owned(with)
}

/// The warmth of all joints in a log that is held out.
fn warmths_in(evidence: &Evidence, hypothesis: &Hypothesis, log: usize) -> Warmths {
    let known = evidence.criteria.prior.warmth.powi(-2);
    let mut sums = vec![(Matrix2::identity() * known, Vector2::zeros()); evidence.joints.len()];
    let stretches = evidence.stretches.iter().enumerate();
    for (s, stretch) in stretches.filter(|(_, stretch)| stretch.log == log) {
        let trial = Trial::of(stretch, hypothesis, &evidence.criteria.fit);
        for (&joint, sums) in evidence.joints.iter().zip(&mut sums) {
            add_rows(sums, evidence, s, joint, &trial);
        }
    }
    let most = MOST_DEVIATIONS * evidence.criteria.prior.warmth;
    let warmth = |(&joint, (normal, against)): (&usize, &(Matrix2<f64>, Vector2<f64>))| {
        let parts = normal.cholesky()?.solve(against).map(|part| part.clamp(-most, most));
        Some(((joint, log), Warmth { parts: parts.into() }))
    };
    evidence.joints.iter().zip(&sums).filter_map(warmth).collect()
}

/// Adds the rows of a joint in a stretch to the normal equations of its warmth.
fn add_rows(
    (normal, against): &mut (Matrix2<f64>, Vector2<f64>),
    evidence: &Evidence,
    s: usize,
    joint: usize,
    trial: &Trial,
) {
    let gain = trial.motor_gain(joint);
    let slopes = trial.warmth_slopes(joint, &trial.friction_slopes(joint)).map(|slope| {
        let slope: Vec<f64> = slope.iter().map(|slope| -slope / gain).collect();
        evidence.weighted(s, joint, &at_samples(&slope))
    });
    let rows = evidence.weighted(s, joint, &trial.residual(joint));
    for (row, (begin, later)) in rows.iter().zip(slopes[0].iter().zip(&slopes[1])) {
        let slope = Vector2::new(*begin, *later);
        *normal += slope * slope.transpose();
        *against -= slope * *row;
    }
}
