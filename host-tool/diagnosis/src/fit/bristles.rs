//! Where the search for bristles begins that no model tells.

use super::unknowns::Unknown;
use crate::logs::subject::{STIFFNESS, Subject};
use crate::rows::evidence::{Evidence, Rows};
use crate::trial::hypothesis::Hypothesis;
use crate::trial::residual_rows::train_residual_rows;

/// Stiffnesses that are tried, in parts of the one that a joint's motion suggests: what leaves least is
/// within a factor of one and a half of the best, from where a fit goes there.
const FACTORS: [f64; 6] = [0.3, 0.6, 1.0, 1.7, 3.0, 8.0];

/// A hypothesis with the stiffness that leaves least, joint by joint, where the model does not tell it. Only
/// an arm's is sought: rows of a joint depend on its own friction alone.
pub fn with_likely_bristles(
    evidence: &Evidence,
    subject: &Subject,
    given: Hypothesis,
) -> Hypothesis {
    let is_open = |joint: &&usize| !subject.knows_bristles(**joint);
    let open: Vec<usize> = subject.joints.iter().filter(is_open).copied().collect();
    if subject.plant.as_chain().is_none() || open.is_empty() {
        return given;
    }
    let scaled = |factor: f64| {
        let mut hypothesis = given.clone();
        open.iter().for_each(|&joint| scale(&mut hypothesis, joint, factor));
        hypothesis
    };
    let left: Vec<Rows> =
        FACTORS.iter().map(|factor| train_residual_rows(evidence, &scaled(*factor))).collect();
    let mut best = given.clone();
    for &joint in &open {
        let squares = |tried: &usize| left[*tried][joint].iter().map(|row| row * row).sum::<f64>();
        let least =
            (0..FACTORS.len()).min_by(|a, b| squares(a).total_cmp(&squares(b))).unwrap_or(2);
        scale(&mut best, joint, FACTORS[least]);
    }
    best
}

fn scale(hypothesis: &mut Hypothesis, joint: usize, factor: f64) {
    let stiffness = Unknown::Friction { joint, parameter: STIFFNESS };
    let now = stiffness.get(hypothesis);
    stiffness.set(hypothesis, factor * now);
}
