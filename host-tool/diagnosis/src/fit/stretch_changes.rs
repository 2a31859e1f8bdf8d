//! What one effect changes of the rows of a stretch.

use std::cell::OnceCell;

use crate::rows::evidence::{Evidence, RowChange};
use crate::trial::equation::Trial;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};
use crate::trial::parts::{Parts, motor_side, touched};

/// Appends the change of joints' rows in a stretch once a model, the one `before` with its `parts`, becomes
/// `hypothesis`, which differs in one of its effects.
pub fn changed(
    evidence: &Evidence,
    s: usize,
    (parts, before): (&Vec<Parts>, &Hypothesis),
    hypothesis: &Hypothesis,
    (effect, others): (&EffectInstance, &[EffectInstance]),
    joints: &[usize],
    change: &mut RowChange,
) {
    let touches = touched(effect, others, &hypothesis.tables);
    let (stretch, criteria) = (&evidence.stretches[s], &evidence.criteria.fit);
    let trial = Trial::with_motor_side(stretch, hypothesis, criteria, motor_side(parts, effect));
    let (of_before, make) = (OnceCell::new(), || Trial::of(stretch, before, criteria));
    for &joint in joints {
        let before = || of_before.get_or_init(make);
        let signal = parts[joint].change_to(&before, &trial, joint, touches);
        change[joint].get_or_insert_default().extend(evidence.weighted(s, joint, &signal));
    }
}

/// Appends the same, to first order, once a spring is added to the model of `parts`.
pub fn changed_by_spring(
    evidence: &Evidence,
    s: usize,
    parts: &Vec<Parts>,
    hypothesis: &Hypothesis,
    spring: &EffectInstance,
    joints: &[usize],
    change: &mut RowChange,
) {
    let trial = Trial::with_motor_side(
        &evidence.stretches[s],
        hypothesis,
        &evidence.criteria.fit,
        motor_side(parts, spring),
    );
    for (&joint, signal) in joints.iter().zip(trial.changes_by_spring(joints)) {
        change[joint].get_or_insert_default().extend(evidence.weighted(s, joint, &signal));
    }
}
