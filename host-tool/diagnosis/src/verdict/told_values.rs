//! How well the logs tell what an effect is by: one that is there is the same in every part of them.

use crate::fit::fitted_model::FittedModel;
use crate::fit::unknowns::Unknown;
use crate::logs::stretch::Stretch;
use crate::trial::hypothesis::EffectInstance;
use files::Role;
use rig::effects::Kind;

/// Whether an effect (the one at `index` of a model) makes commands late by a time that is not told, or that differs
/// from log to log by more than chance: a drive is late by the same time in every log, what play loses at reversals
/// differs from motion to motion.
pub fn is_unsteady(model: &FittedModel, index: usize) -> bool {
    let most = model.evidence.criteria.verdict.most_of_time;
    let effect = &model.linear.hypothesis.effects[index];
    let FittedModel { linear, evidence, .. } = model;
    let half_interval = |place: usize| linear.half_intervals_beyond_chance(evidence)[place];
    let is_steady = |place| is_within(effect.values[0], half_interval(place), most);
    let place = linear.place_of(Unknown::Effect { index, value: 0 });
    effect.is_late() && !place.is_none_or(is_steady)
}

/// Whether an effect is a spring between motor and link whose stiffness the logs do not tell, and no log of another motion
/// confirms it: a link that flies freely stands for whatever pushes at it from outside, by any stiffness.
pub fn is_loose(model: &FittedModel, index: usize) -> bool {
    let most = model.evidence.criteria.verdict.most_of_stiffness;
    let effect = &model.linear.hypothesis.effects[index];
    let value = stiffness(effect).filter(|_| effect.is_spring());
    value.is_some_and(|value| {
        !is_told(model, index, value, most) && !is_confirmed_elsewhere(&model.evidence.stretches)
    })
}

/// Whether an effect may be none at all: the 95 % intervals of its first value, and of those that are of the same kind,
/// as the components of a force are, lie on both sides of nothing. Springs and limits do not grow with theirs.
pub fn may_be_nothing(model: &FittedModel, index: usize) -> bool {
    const ALL: f64 = 1.0;
    let definition = model.linear.hypothesis.effects[index].definition;
    let first = definition.parameters[0].kind;
    let values = definition.parameters.iter().enumerate().filter(|(_, p)| p.kind == first);
    let mut open = values.map(|(value, _)| is_told(model, index, value, ALL));
    definition.size.grows && !open.any(|is_told| is_told)
}

/// Whether a log is held out of which no part is for training.
fn is_confirmed_elsewhere(stretches: &[Stretch]) -> bool {
    let (train, held_out): (Vec<&Stretch>, Vec<&Stretch>) =
        stretches.iter().partition(|stretch| stretch.role == Role::Train);
    held_out.iter().any(|held_out| train.iter().all(|train| train.log != held_out.log))
}

/// Where among an effect's values its stiffness stands.
fn stiffness(effect: &EffectInstance) -> Option<usize> {
    effect.definition.parameters.iter().position(|parameter| parameter.kind == Kind::Stiffness)
}

/// Whether half the 95 % interval of an effect's value is at most this part of it, or the value is not open.
fn is_told(model: &FittedModel, index: usize, value: usize, most_of_value: f64) -> bool {
    let FittedModel { linear, evidence, .. } = model;
    let Some(place) = linear.place_of(Unknown::Effect { index, value }) else { return true };
    let half_interval = linear.half_intervals(evidence)[place];
    is_within(linear.hypothesis.effects[index].values[value], half_interval, most_of_value)
}

fn is_within(value: f64, half_interval: f64, most_of_value: f64) -> bool {
    half_interval <= most_of_value * value.abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Criteria;

    /// Play of 7 mrad on an axis, told as a delay, and a delay on another.
    #[test]
    fn what_is_late_by_other_times_elsewhere_is_not_told() {
        let most = Criteria::default().verdict.most_of_time;
        assert!(!is_within(11.3e-3, 4.4e-3, most));
        assert!(is_within(2.53e-3, 0.33e-3, most));
    }

    /// Friction by load of a clean geared arm at 250 Hz.
    #[test]
    fn a_size_with_an_interval_on_both_sides_of_nothing_may_be_nothing() {
        assert!(!is_within(0.0213, 0.0247, 1.0));
    }

    #[test]
    fn a_spring_is_told_by_its_stiffness() {
        let most = Criteria::default().verdict.most_of_stiffness;
        assert!(!is_within(31.7, 29.2, most), "play that stands for pushes by hand");
        assert!(is_within(78.2, 34.4, most), "the least told of those that were there");
    }
}
