//! A model without one of its effects.

use crate::fit::fitted_model::FittedModel;
use crate::logs::subject::Subject;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};

/// A model without the effect at this place, refitted from where it is, or from the parameters of the model without any
/// effect, `refitted`, where it has come to rest far from them: an effect is not worth what takes a fit back.
pub fn without(
    subject: &Subject,
    refitted: &FittedModel,
    last: &FittedModel,
    place: usize,
) -> Option<FittedModel> {
    let FittedModel { linear, evidence, .. } = last;
    let steps = subject.criteria.selection.accepted_steps;
    let mut hypothesis = linear.hypothesis.clone();
    let effect = hypothesis.effects.remove(place);
    let near = FittedModel::fitted_near(linear, evidence, subject, hypothesis, steps)?;
    if !leaves_more(subject, &near, refitted, &effect) {
        return Some(near);
    }
    let effects = near.linear.hypothesis.effects.clone();
    let start = Hypothesis { effects, ..refitted.linear.hypothesis.clone() };
    let Some(anew) = FittedModel::fitted(evidence, subject, start, steps) else {
        return Some(near);
    };
    Some(near.better_of(anew.without_parts()))
}

/// Whether a model leaves more of a joint on which `effect` would act and none of its own does than the model without
/// any effect leaves.
fn leaves_more(
    subject: &Subject,
    model: &FittedModel,
    refitted: &FittedModel,
    effect: &EffectInstance,
) -> bool {
    let others = &model.linear.hypothesis.effects[subject.known_effects.len()..];
    let most = 1.0 + subject.criteria.verdict.least_excess;
    let left_v2 = |model: &FittedModel, joint: usize| -> f64 {
        model.residual_v[joint].iter().map(|row| row * row).sum()
    };
    let mut joints = subject.joints.iter().copied();
    joints.any(|joint| {
        acts_on(effect, joint)
            && !others.iter().any(|other| acts_on(other, joint))
            && left_v2(model, joint) > most * left_v2(refitted, joint)
    })
}

/// Whether an effect acts on a joint (from 0).
fn acts_on(effect: &EffectInstance, joint: usize) -> bool {
    effect.joint == 0 || usize::from(effect.joint) == joint + 1
}
