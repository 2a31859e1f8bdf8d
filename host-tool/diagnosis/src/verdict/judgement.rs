//! The causes that are named, with what they are worth, and what else was tried.

use super::confirmed::{Confirmation, Held, Worth};
use super::decision::{is_named, is_sound, probability};
use super::misfit::joints_of_another;
use crate::fit::fitted_model::FittedModel;
use crate::logs::subject::Subject;
use crate::search::selection::{Added, Rival, Selection, update_gains};
use crate::tables::ceiling::reaches_ceiling;
use crate::trial::hypothesis::EffectInstance;

/// What the search amounts to.
pub struct Judgement<'a> {
    /// The refitted model.
    pub refitted: FittedModel,
    /// The model with the causes that are named, and no others.
    pub last: FittedModel,
    /// The causes, in the order of the model's.
    pub named: Vec<Named>,
    /// Effects that were added by the search but are not confirmed.
    pub unconfirmed: Vec<(EffectInstance, Worth, f64)>,
    /// Candidates that were not accepted at the end.
    pub refused: Vec<Rival>,
    /// The models on the confirming logs.
    pub confirmation: Confirmation<'a>,
}

/// A cause that is named.
pub struct Named {
    /// What the search knows of it.
    pub added: Added,
    /// What it is worth on the confirming logs.
    pub worth: Worth,
    /// Probability that it is a cause.
    pub probability: f64,
}

impl<'a> Judgement<'a> {
    /// Judges a selection; `noise_v` is that of rows, rms by joint and stretch [V].
    pub fn of(subject: &'a Subject, selection: Selection, noise_v: &[Vec<f64>]) -> Self {
        let Selection { refitted, mut last, mut added, refused } = selection;
        let mut unconfirmed = Vec::new();
        let held = Held::of(subject, &refitted);
        let anothers = joints_of_another(subject, &refitted);
        // Of the whole model: without a cause that is not confirmed, parameters go astray anew.
        let is_plausible = !last.stats.is_implausible(&subject.criteria.fit);
        loop {
            let confirmation =
                Confirmation::of(subject, held.clone(), &last, &added, noise_v.to_vec());
            let judged: Vec<(Worth, f64)> = (0..added.len())
                .map(|index| judged(subject, &confirmation, &last, &added[index], index))
                .collect();
            let fails = |index: &usize| {
                !is_plausible
                    || is_anothers(&confirmation, &last, &anothers, *index)
                    || !is_confirmed(&confirmation, &last, &added[*index], *index, &judged[*index])
            };
            let least = |a: &usize, b: &usize| judged[*a].0.share.total_cmp(&judged[*b].0.share);
            let worst = (0..added.len()).filter(fails).min_by(least);
            let without = worst.and_then(|index| Some((index, without(subject, &last, index)?)));
            let Some((index, (effect, model))) = without else {
                let named = added.into_iter().zip(judged).map(Named::of).collect();
                return Self { refitted, last, named, unconfirmed, refused, confirmation };
            };
            let (worth, probability) = judged[index];
            unconfirmed.push((effect, worth, probability));
            added.remove(index);
            last = model;
            update_gains(subject, &last, &mut added);
        }
    }
}

impl Named {
    fn of((added, (worth, probability)): (Added, (Worth, f64))) -> Self {
        Self { added, worth, probability }
    }
}

/// Whether the cause at this place among those added acts on joints whose logs are as of another robot,
/// and causes do not explain nearly all of what is left there.
fn is_anothers(
    confirmation: &Confirmation,
    last: &FittedModel,
    anothers: &[usize],
    index: usize,
) -> bool {
    let subject = confirmation.subject;
    let effect = &last.linear.hypothesis.effects[subject.known_effects.len() + index];
    let acts_on = |joint: &usize| effect.joint == 0 || usize::from(effect.joint) == joint + 1;
    let touched: Vec<usize> = anothers.iter().copied().filter(acts_on).collect();
    !touched.is_empty()
        && confirmation.explained_on(last, &touched) < subject.criteria.verdict.explained
}

/// Whether the cause at this place among those added is named.
fn is_confirmed(
    confirmation: &Confirmation,
    last: &FittedModel,
    added: &Added,
    index: usize,
    (worth, probability): &(Worth, f64),
) -> bool {
    let subject = confirmation.subject;
    let criteria = &subject.criteria.verdict;
    let place = subject.known_effects.len() + index;
    let effect = &last.linear.hypothesis.effects[place];
    is_named(*probability, worth, criteria)
        && is_sound(effect, worth, criteria)
        && !(effect.is_spring() && confirmation.takes_noise(last, effect))
        && reaches_ceiling(subject, &added.without, last, place)
}

/// The effect at this place among those added, and the model refitted without it.
fn without(
    subject: &Subject,
    last: &FittedModel,
    index: usize,
) -> Option<(EffectInstance, FittedModel)> {
    let mut hypothesis = last.linear.hypothesis.clone();
    let effect = hypothesis.effects.remove(subject.known_effects.len() + index);
    let steps = subject.criteria.selection.accepted_steps;
    let model = FittedModel::fitted_near(&last.linear, &last.evidence, subject, hypothesis, steps)?;
    Some((effect, model))
}

fn judged(
    subject: &Subject,
    confirmation: &Confirmation,
    last: &FittedModel,
    added: &Added,
    index: usize,
) -> (Worth, f64) {
    let worth = confirmation.worth(last, index);
    (worth, probability(added, &worth, &subject.criteria.verdict))
}
