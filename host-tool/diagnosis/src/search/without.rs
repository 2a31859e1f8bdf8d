//! A model without one of its effects.

use crate::fit::fitted_model::FittedModel;
use crate::logs::subject::Subject;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};

/// A model without the effect at this place, refitted from the parameters that it has. Where that ends in a local minimum,
/// it is fitted from the friction and the lag that the effect's joint has in the model without any effect, `refitted`, too,
/// and the likelier is taken: what leads a fit out of a local minimum is not explained by the effect.
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
    let Some(joint) = joint_left_worse(subject, &near, refitted, &effect) else {
        return Some(near);
    };
    let start = with_joint_of(&near.linear.hypothesis, &refitted.linear.hypothesis, joint);
    let Some(anew) = FittedModel::fitted(evidence, subject, start, steps) else {
        return Some(near);
    };
    Some(near.better_of(anew.without_parts()))
}

/// The joint (from 0) of an effect where the model, without any other effect on it, leaves more than the one without any
/// effect at all (`local_minimum_ratio`).
fn joint_left_worse(
    subject: &Subject,
    model: &FittedModel,
    refitted: &FittedModel,
    effect: &EffectInstance,
) -> Option<usize> {
    let joint = usize::from(effect.joint).checked_sub(1)?;
    let others = &model.linear.hypothesis.effects[subject.known_effects.len()..];
    let left_v2 = |model: &FittedModel| model.residual_v[joint].iter().map(|row| row * row).sum();
    let (left_v2, refitted_v2): (f64, f64) = (left_v2(model), left_v2(refitted));
    let most = subject.criteria.selection.local_minimum_ratio;
    (is_alone(effect, others) && left_v2 > most * refitted_v2).then_some(joint)
}

/// Whether no other effect acts on the joint of one, none of the whole arm either: with one of several missing, a fit may
/// well leave more than without any.
fn is_alone(effect: &EffectInstance, others: &[EffectInstance]) -> bool {
    others.iter().all(|other| other.joint != 0 && other.joint != effect.joint)
}

/// A model with the friction and the lag that a joint has in another.
fn with_joint_of(model: &Hypothesis, other: &Hypothesis, joint: usize) -> Hypothesis {
    let mut model = model.clone();
    model.plant.friction[joint] = other.plant.friction[joint];
    model.lag_s[joint] = other.lag_s[joint];
    model.friction_lead_s[joint] = other.friction_lead_s[joint];
    model
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::reference_robot::reference_robot;
    use rig::effects::Catalogue;
    use rig::plant::Plant;

    #[test]
    fn an_effect_is_alone_where_no_other_acts_on_its_joint_or_on_the_whole_arm() {
        let on = |name: &str, joint: u8| {
            let definition = Catalogue::standard().by_name(name).unwrap();
            EffectInstance { definition, joint, values: vec![0.1; definition.parameters.len()] }
        };
        let offset = on("dac_offset", 2);
        assert!(is_alone(&offset, &[]) && is_alone(&offset, &[on("cogging", 1)]));
        assert!(!is_alone(&offset, &[on("cogging", 1), on("cogging", 2)]));
        assert!(!is_alone(&offset, &[on("payload", 0)]));
    }

    #[test]
    fn a_joint_takes_its_friction_and_lag_and_the_others_keep_theirs() {
        let model = Hypothesis::bare(Plant::of_robot(&reference_robot()));
        let mut other = model.clone();
        other.plant.friction.iter_mut().for_each(|friction| friction.alpha0_v *= 2.0);
        other.lag_s = vec![1e-3; 3];
        let mixed = with_joint_of(&model, &other, 1);
        assert_eq!(mixed.lag_s, [0.0, 1e-3, 0.0]);
        assert_eq!(mixed.plant.friction[1], other.plant.friction[1]);
        for joint in [0, 2] {
            assert_eq!(mixed.plant.friction[joint], model.plant.friction[joint]);
        }
    }
}
