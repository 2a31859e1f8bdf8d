//! The warmth of joints in logs that are held out: it is the log's own, as what bristles are bent by is, and no fit to
//! other logs tells it.

use std::borrow::Cow;

use nalgebra::{Matrix2, Vector2};

use super::equation::Trial;
use super::hypothesis::Hypothesis;
use super::warmth::Warmth;
use crate::logs::intervals::at_samples;
use crate::rows::evidence::Evidence;

/// A hypothesis with the warmth that held-out logs tell, where it has one in train logs: least squares of each joint's
/// rows in each log, by what is known of warmth beforehand.
pub fn with_held_warmth<'a>(
    evidence: &Evidence,
    hypothesis: &'a Hypothesis,
) -> Cow<'a, Hypothesis> {
    if hypothesis.warmths.is_empty() {
        return Cow::Borrowed(hypothesis);
    }
    let held: Vec<usize> = (evidence.train_stretches()..evidence.stretches.len()).collect();
    let mut with = hypothesis.clone();
    for of_log in held.chunk_by(|&a, &b| evidence.stretches[a].log == evidence.stretches[b].log) {
        let log = evidence.stretches[of_log[0]].log;
        for &joint in &evidence.joints {
            if let Some(warmth) = warmth_of(evidence, hypothesis, joint, of_log) {
                with.warmths.insert((joint, log), warmth);
            }
        }
    }
    Cow::Owned(with)
}

/// The warmth of a joint by its rows in these stretches of a log.
fn warmth_of(
    evidence: &Evidence,
    hypothesis: &Hypothesis,
    joint: usize,
    stretches: &[usize],
) -> Option<Warmth> {
    let known = evidence.criteria.prior.warmth.powi(-2);
    let (mut normal, mut against) = (Matrix2::identity() * known, Vector2::zeros());
    for &s in stretches {
        let trial = Trial::of(&evidence.stretches[s], hypothesis, &evidence.criteria.fit);
        let rows = evidence.weighted(s, joint, &trial.residual(joint));
        let slopes = trial.warmth_slopes(joint, &trial.friction_slopes(joint));
        let gain = trial.motor_gain(joint);
        let slopes = slopes.map(|slope| {
            let slope: Vec<f64> = slope.iter().map(|slope| -slope / gain).collect();
            evidence.weighted(s, joint, &at_samples(&slope))
        });
        for (k, row) in rows.iter().enumerate() {
            let slope = Vector2::new(slopes[0][k], slopes[1][k]);
            normal += slope * slope.transpose();
            against -= slope * *row;
        }
    }
    let parts = normal.cholesky()?.solve(&against);
    Some(Warmth { parts: parts.into() })
}
