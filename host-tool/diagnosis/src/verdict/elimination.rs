//! Effects taken out of a model one after the other, as long as one is not confirmed.

use super::confirmed::Confirmation;
use super::decision::{is_named, is_no_gap, is_sound, probability};
use super::held::Held;
use super::misfit::joints_of_another;
use super::worth::Worth;
use crate::fit::fitted_model::FittedModel;
use crate::logs::subject::Subject;
use crate::model_faults::is_by_lengths;
use crate::search::found::{Added, Rival, Selection};
use crate::search::selection::update_gains;
use crate::tables::ceiling::reaches_ceiling;
use crate::trial::hypothesis::EffectInstance;

/// What an effect amounts to.
#[derive(Clone, Copy, Debug)]
pub struct Judged {
    /// Its worth as it is told.
    pub worth: Worth,
    /// Its worth by which it is judged, joints in units of what is left on each.
    pub weighed: Worth,
    /// The probability that it is a cause.
    pub probability: f64,
}

/// The model of a selection, less and less of it.
pub struct Elimination<'a> {
    subject: &'a Subject,
    /// The refitted model.
    pub refitted: FittedModel,
    /// The same within the doubt about it.
    held: Held,
    /// The model with the effects that are left.
    pub last: FittedModel,
    /// Those effects, in the order of the model's.
    pub added: Vec<Added>,
    /// Those that were taken out.
    pub unconfirmed: Vec<(EffectInstance, Worth, f64)>,
    /// Candidates that were not accepted at the end.
    pub refused: Vec<Rival>,
    /// Joints (from 0) whose logs are as of another robot.
    anothers: Vec<usize>,
    /// Whether the whole model is: without an effect, parameters go astray anew.
    is_plausible: bool,
    noise_v: Vec<Vec<f64>>,
}

impl<'a> Elimination<'a> {
    /// All that was selected; `noise_v` is that of rows, rms by joint and stretch [V].
    pub fn of(subject: &'a Subject, selection: Selection, noise_v: &[Vec<f64>]) -> Self {
        let Selection { refitted, last, added, refused } = selection;
        Self {
            held: Held::of(subject, &refitted),
            anothers: joints_of_another(subject, &refitted),
            is_plausible: !last.stats.is_implausible(&subject.criteria.fit),
            unconfirmed: Vec::new(),
            subject,
            refitted,
            last,
            added,
            refused,
            noise_v: noise_v.to_vec(),
        }
    }

    /// The models with and without the effects that are left, on the confirming logs.
    pub fn confirmation(&self) -> Confirmation<'a> {
        let Self { subject, last, added, held, noise_v, .. } = self;
        Confirmation::of(subject, held.clone(), last, added, noise_v.clone())
    }

    /// The same, and what those effects are worth.
    pub fn judged(&self) -> (Confirmation<'a>, Vec<Judged>) {
        let Self { subject, last, added, .. } = self;
        let confirmation = self.confirmation();
        let judged = |(index, added): (usize, &Added)| {
            let worth = confirmation.worth(last, index);
            let weighed = confirmation.weighed_worth(last, index, worth);
            let probability = probability(added, &weighed, &subject.criteria.verdict);
            Judged { worth, weighed, probability }
        };
        let judged = added.iter().enumerate().map(judged).collect();
        (confirmation, judged)
    }

    /// The smallest effect that cannot be a cause or is not likely to be one.
    pub fn unlikely(&self, confirmation: &Confirmation, judged: &[Judged]) -> Option<usize> {
        let least = self.subject.criteria.verdict.least_probability;
        let fails = |index: &usize| {
            judged[*index].probability < least
                || !self.can_be(confirmation, *index, &judged[*index].weighed)
        };
        self.smallest(judged, fails)
    }

    fn smallest(&self, judged: &[Judged], fails: impl Fn(&usize) -> bool) -> Option<usize> {
        let share = |index: &usize| judged[*index].weighed.share;
        let indices = (0..self.added.len()).filter(fails);
        indices.min_by(|a, b| share(a).total_cmp(&share(b)))
    }

    /// Those `among` some effects that are likely but not named: too small, or less than what something along
    /// their axis could explain.
    fn not_named(
        &self,
        confirmation: &Confirmation,
        judged: &[Judged],
        among: impl Iterator<Item = usize>,
    ) -> Vec<usize> {
        let criteria = &self.subject.criteria.verdict;
        let of_arm = confirmation.explained(&self.last);
        let no_gap = is_no_gap(&self.refitted, &self.last, confirmation, criteria);
        let fails = |index: &usize| {
            let Judged { worth, weighed, probability } = &judged[*index];
            let without = &self.added[*index].without;
            let effect = &self.last.linear.hypothesis.effects[self.place(*index)];
            // Where the arm has no gap, other joints are left with what noise is known by.
            let own = || confirmation.explained_on(&self.last, &confirmation.joints_of(effect));
            let explained = if no_gap { own() } else { of_arm };
            !self.can_be(confirmation, *index, weighed)
                || worth.share <= 0.0
                || !is_named(*probability, weighed, explained, no_gap, criteria)
                || !reaches_ceiling(self.subject, without, &self.last, self.place(*index))
        };
        among.filter(fails).collect()
    }

    /// Takes out effects that are not named, the smallest first, as long as they are not named without those before
    /// either: several small ones may share what one of them takes alone. What the effects that stay are worth:
    /// as judged beside the small ones, but those that are named only without them.
    pub fn take_out_small(
        &mut self,
        confirmation: &Confirmation,
        mut judged: Vec<Judged>,
    ) -> Vec<Judged> {
        let mut told = judged.clone();
        let mut small = self.not_named(confirmation, &judged, 0..self.added.len());
        while let Some(index) = self.smallest(&judged, |index| small.contains(index)) {
            small.retain(|other| *other != index);
            // One without which nothing can be fitted stays.
            if !self.take_out(index, judged[index]) {
                continue;
            }
            told.remove(index);
            small.iter_mut().filter(|other| **other > index).for_each(|other| *other -= 1);
            if small.is_empty() {
                break;
            }
            let now;
            (now, judged) = self.judged();
            let still = self.not_named(&now, &judged, small.iter().copied());
            let named = small.iter().filter(|index| !still.contains(index));
            named.for_each(|index| told[*index] = judged[*index]);
            small = still;
        }
        told
    }

    /// Takes an effect out and refits the model; false where that cannot be fitted.
    pub fn take_out(&mut self, index: usize, judged: Judged) -> bool {
        let Some((effect, model)) = self.without(index) else { return false };
        self.unconfirmed.push((effect, judged.worth, judged.probability));
        self.added.remove(index);
        self.last = if self.added.is_empty() { self.refitted.clone() } else { model };
        update_gains(self.subject, &self.last, &mut self.added);
        true
    }

    /// Whether an effect can be a cause at all: of this robot, and what it says.
    fn can_be(&self, confirmation: &Confirmation, index: usize, weighed: &Worth) -> bool {
        let effect = &self.last.linear.hypothesis.effects[self.place(index)];
        self.is_plausible
            && !self.is_anothers(confirmation, effect)
            && is_sound(effect, weighed, &self.subject.criteria.verdict)
            && !(effect.is_spring() && confirmation.takes_noise(&self.last, effect))
            && confirmation.acts(&self.last, index)
            && !is_by_lengths(self.subject, &self.added[index].without, effect)
    }

    /// Whether an effect acts on joints whose logs are as of another robot, and causes do not explain
    /// nearly all of what is left there.
    fn is_anothers(&self, confirmation: &Confirmation, effect: &EffectInstance) -> bool {
        let acts_on = |joint: &usize| effect.joint == 0 || usize::from(effect.joint) == joint + 1;
        let touched: Vec<usize> = self.anothers.iter().copied().filter(acts_on).collect();
        let explained = self.subject.criteria.verdict.explained;
        !touched.is_empty() && confirmation.explained_on(&self.last, &touched) < explained
    }

    /// The effect at this place among those left, and the model refitted without it.
    fn without(&self, index: usize) -> Option<(EffectInstance, FittedModel)> {
        let FittedModel { linear, evidence, .. } = &self.last;
        let mut hypothesis = linear.hypothesis.clone();
        let effect = hypothesis.effects.remove(self.place(index));
        let steps = self.subject.criteria.selection.accepted_steps;
        let model = FittedModel::fitted_near(linear, evidence, self.subject, hypothesis, steps)?;
        Some((effect, model))
    }

    /// Where an effect stands among those of the model, which may know some of its own.
    fn place(&self, index: usize) -> usize {
        self.subject.known_effects.len() + index
    }
}
