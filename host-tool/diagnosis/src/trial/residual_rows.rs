//! What a hypothesis leaves of logs, as rows.

use rayon::prelude::*;

use super::equation::Trial;
use super::hypothesis::Hypothesis;
use crate::rows::evidence::{Evidence, Rows};

/// Rows of a hypothesis on the joints of the rig, of all logs.
pub fn residual_rows(evidence: &Evidence, hypothesis: &Hypothesis) -> Rows {
    of_first(evidence.stretches.len(), evidence, hypothesis)
}

/// The same of train logs.
pub fn train_residual_rows(evidence: &Evidence, hypothesis: &Hypothesis) -> Rows {
    of_first(evidence.train_stretches(), evidence, hypothesis)
}

fn of_first(stretches: usize, evidence: &Evidence, hypothesis: &Hypothesis) -> Rows {
    let pieces: Vec<Rows> = (0..stretches)
        .into_par_iter()
        .map(|s| {
            let trial = Trial::of(&evidence.stretches[s], hypothesis, &evidence.criteria.fit);
            let mut rows = evidence.no_rows();
            for &joint in &evidence.joints {
                rows[joint] = evidence.weighted(s, joint, &trial.residual(joint));
            }
            rows
        })
        .collect();
    let of_joint = |joint: usize| pieces.iter().flat_map(|piece| &piece[joint]).copied().collect();
    (0..evidence.joint_count()).map(of_joint).collect()
}
