//! What one effect changes of the rows of the stretches of a model.

use std::cell::OnceCell;

use rayon::prelude::*;

use crate::rows::evidence::{Evidence, RowChange};
use crate::trial::equation::Trial;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};
use crate::trial::parts::{Parts, motor_side, touched};

/// Change of joints' rows once a model, the one `before` with its `parts`, becomes `hypothesis`, which differs in one of
/// its effects.
pub fn changed(
    evidence: &Evidence,
    (parts, before): (&[Vec<Parts>], &Hypothesis),
    hypothesis: &Hypothesis,
    (effect, others): (&EffectInstance, &[EffectInstance]),
    joints: &[usize],
) -> RowChange {
    let touches = touched(effect, others, &hypothesis.tables);
    let criteria = &evidence.criteria.fit;
    by_stretches(evidence, parts, joints, |s, parts| {
        let stretch = &evidence.stretches[s];
        let trial =
            Trial::with_motor_side(stretch, hypothesis, criteria, motor_side(parts, effect));
        let (of_before, make) = (OnceCell::new(), || Trial::of(stretch, before, criteria));
        let before = || of_before.get_or_init(make);
        joints.iter().map(|&j| parts[j].change_to(&before, &trial, j, touches)).collect()
    })
}

/// The same, to first order, once a spring is added to the model of `parts`.
pub fn changed_by_spring(
    evidence: &Evidence,
    parts: &[Vec<Parts>],
    hypothesis: &Hypothesis,
    spring: &EffectInstance,
    joints: &[usize],
) -> RowChange {
    by_stretches(evidence, parts, joints, |s, parts| {
        let (stretch, criteria) = (&evidence.stretches[s], &evidence.criteria.fit);
        let side = motor_side(parts, spring);
        Trial::with_motor_side(stretch, hypothesis, criteria, side).changes_by_spring(joints)
    })
}

/// Rows of what is changed of these joints at the samples of each stretch.
fn by_stretches(
    evidence: &Evidence,
    parts: &[Vec<Parts>],
    joints: &[usize],
    signals: impl Fn(usize, &Vec<Parts>) -> Vec<Vec<f64>> + Sync,
) -> RowChange {
    let of_stretch = |(s, parts): (usize, &Vec<Parts>)| -> Vec<Vec<f64>> {
        let both = joints.iter().zip(signals(s, parts));
        both.map(|(&joint, signal)| evidence.weighted(s, joint, &signal)).collect()
    };
    let pieces: Vec<Vec<Vec<f64>>> = parts.par_iter().enumerate().map(of_stretch).collect();
    let mut change = evidence.no_change();
    for (place, &joint) in joints.iter().enumerate() {
        change[joint] = Some(pieces.iter().flat_map(|piece| &piece[place]).copied().collect());
    }
    change
}
