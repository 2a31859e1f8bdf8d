//! What a hypothesis leaves of logs, as rows.

use rayon::prelude::*;

use super::equation::Trial;
use super::held_warmth::with_held_warmth;
use super::hypothesis::Hypothesis;
use super::rigid_rows::needed_rows;
use crate::rows::evidence::{Evidence, Rows};

/// Rows of a hypothesis on the joints of the rig, of all logs.
pub fn residual_rows(evidence: &Evidence, hypothesis: &Hypothesis) -> Rows {
    let hypothesis = with_held_warmth(evidence, hypothesis);
    of_first(evidence.stretches.len(), evidence, &hypothesis)
}

/// The same of a hypothesis in logs as warm as another tells that those held out are.
pub fn residual_rows_as_warm_as(
    evidence: &Evidence,
    hypothesis: &Hypothesis,
    other: &Hypothesis,
) -> Rows {
    let warmths = with_held_warmth(evidence, other).warmths.clone();
    let hypothesis = Hypothesis { warmths, ..hypothesis.clone() };
    of_first(evidence.stretches.len(), evidence, &hypothesis)
}

/// Rows of a hypothesis in train logs.
pub fn train_residual_rows(evidence: &Evidence, hypothesis: &Hypothesis) -> Rows {
    of_first(evidence.train_stretches(), evidence, hypothesis)
}

/// Rows of a trial on a joint in a stretch of a train log, by what drives the joint less friction [V].
pub fn train_rows_of(
    evidence: &Evidence,
    s: usize,
    joint: usize,
    trial: &Trial,
    net_v: &[f64],
) -> Vec<f64> {
    if !trial.has_measured_body() {
        return evidence.weighted(s, joint, &trial.residual_of_net(joint, net_v));
    }
    let (mut given, gain) = (trial.given(joint, net_v), trial.motor_gain(joint));
    if let Some(payload) = trial.payload() {
        let needed = trial.needed_by(&payload, joint);
        given.iter_mut().zip(needed).for_each(|(given, needed)| *given -= needed / gain);
    }
    let mut rows = evidence.filter(joint, s).rows(&given);
    let needed = needed_rows(evidence, s, joint, trial);
    rows.iter_mut().zip(needed).for_each(|(row, needed)| *row += needed / gain);
    evidence.weigh(s, joint, &mut rows);
    rows
}

fn of_first(stretches: usize, evidence: &Evidence, hypothesis: &Hypothesis) -> Rows {
    let joints = &evidence.joints;
    let of_stretch = |s: usize| {
        let trial = Trial::of(&evidence.stretches[s], hypothesis, &evidence.criteria.fit);
        let of_joint = |&joint: &usize| rows_of(evidence, s, joint, &trial);
        joints.par_iter().map(of_joint).collect()
    };
    // Of each stretch the rig's joints, in their order.
    let pieces: Vec<Vec<Vec<f64>>> = (0..stretches).into_par_iter().map(of_stretch).collect();
    let mut rows = evidence.no_rows();
    for (place, &joint) in joints.iter().enumerate() {
        rows[joint] = pieces.iter().flat_map(|piece| &piece[place]).copied().collect();
    }
    rows
}

fn rows_of(evidence: &Evidence, s: usize, joint: usize, trial: &Trial) -> Vec<f64> {
    match s < evidence.train_stretches() {
        true => train_rows_of(evidence, s, joint, trial, &trial.net(joint)),
        false => evidence.weighted(s, joint, &trial.residual(joint)),
    }
}
