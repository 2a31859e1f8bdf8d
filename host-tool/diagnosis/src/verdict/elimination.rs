//! Effects taken out of a model one after the other, as long as one is not confirmed.

use rayon::prelude::*;

use super::confirmed::Confirmation;
use super::decision::{is_no_gap, probability, why_not_named, why_unlikely};
use super::held::Held;
use super::judged::{Judged, Reason, Withheld};
use super::misfit::joints_of_another;
use super::told_values::{is_loose, is_unsteady, may_be_nothing};
use super::wave_of_friction::is_left_by_friction;
use super::worth::Worth;
use crate::fit::fitted_model::FittedModel;
use crate::logs::subject::Subject;
use crate::model_faults::is_by_lengths;
use crate::search::found::{Added, Rival, Selection};
use crate::search::selection::update_gains;
use crate::search::without::without;
use crate::tables::ceiling::reaches_ceiling;
use crate::tables::tone::reaches_tone;
use crate::trial::hypothesis::EffectInstance;

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
    pub withheld: Vec<Withheld>,
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
            withheld: Vec::new(),
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
            let effect = &last.linear.hypothesis.effects[self.place(index)];
            let likely =
                |worth: &Worth| probability(effect, added, worth, &subject.criteria.verdict);
            confirmation.judged(last, index, likely)
        };
        let judged = added.par_iter().enumerate().map(judged).collect();
        (confirmation, judged)
    }

    /// The smallest effect that cannot be a cause or is not likely to be one, and why.
    pub fn unlikely(
        &self,
        confirmation: &Confirmation,
        judged: &[Judged],
    ) -> Option<(usize, Reason)> {
        let criteria = &self.subject.criteria.verdict;
        let fails = |index: usize| {
            let Judged { weighed, probability, counts_in_full, .. } = &judged[index];
            let reason = if *probability < criteria.least_probability {
                let effect = &self.last.linear.hypothesis.effects[self.place(index)];
                let unlikely = || match counts_in_full {
                    true => why_unlikely(&self.added[index], weighed, criteria),
                    false => Reason::Idle,
                };
                Some(self.of_wrong_model(confirmation, effect).unwrap_or_else(unlikely))
            } else {
                self.cannot_be(confirmation, index)
            };
            Some((index, reason?))
        };
        let failing: Vec<_> = (0..self.added.len()).filter_map(fails).collect();
        smallest(judged, &failing)
    }

    /// Those `among` some effects, which are likely, that are not named all the same, and why.
    fn not_named(
        &self,
        confirmation: &Confirmation,
        judged: &[Judged],
        among: &[usize],
    ) -> Vec<(usize, Reason)> {
        let criteria = &self.subject.criteria.verdict;
        let of_arm = confirmation.explained(&self.last);
        let no_gap = is_no_gap(&self.refitted, &self.last, confirmation, criteria);
        let fails = |index: usize| {
            let Judged { worth, weighed, probability, counts_in_full, .. } = &judged[index];
            let without = &self.added[index].without;
            let effect = &self.last.linear.hypothesis.effects[self.place(index)];
            // Where the arm has no gap, other joints are left with what noise is known by.
            let own = || confirmation.explained_on(&self.last, &confirmation.joints_of(effect));
            let explained = if no_gap { own() } else { of_arm };
            let is_below =
                || !reaches_ceiling(self.subject, without, &self.last, self.place(index));
            let is_below_tone =
                || !reaches_tone(self.subject, without, &self.last, self.place(index));
            let nothing_told = || may_be_nothing(&self.last, self.place(index));
            let too_little = || {
                let nothing = (worth.share <= 0.0).then_some(Reason::NoShare);
                nothing
                    .or_else(|| {
                        why_not_named(effect, *probability, weighed, explained, no_gap, criteria)
                    })
                    .or_else(|| (no_gap && nothing_told()).then_some(Reason::NoSize))
            };
            let idle = |reason| if *counts_in_full { reason } else { Reason::Idle };
            let reason = self
                .cannot_be(confirmation, index)
                .or_else(|| too_little().map(idle))
                .or_else(|| is_below_tone().then_some(Reason::Tone))
                .or_else(|| is_below().then_some(Reason::Ceiling))?;
            Some((index, reason))
        };
        let mut failing: Vec<_> = among.iter().copied().filter_map(fails).collect();
        failing.extend(self.left_by_waves(judged, among, &failing));
        failing
    }

    /// Waves of voltage `among` some effects that a wave of friction leaves; those that are `failing` do not count.
    fn left_by_waves(
        &self,
        judged: &[Judged],
        among: &[usize],
        failing: &[(usize, Reason)],
    ) -> Vec<(usize, Reason)> {
        let most = self.subject.criteria.verdict.most_by_wave;
        let effects = &self.last.linear.hypothesis.effects[self.place(0)..];
        let with_share = |index: usize| (&effects[index], judged[index].share_with_it);
        let stays = |index: &usize| failing.iter().all(|(other, _)| other != index);
        let is_left_by = |index: usize, other: usize| {
            let gears = &self.subject.plant.gears;
            is_left_by_friction(with_share(index), with_share(other), most, gears)
        };
        let is_left =
            |index: &usize| (0..effects.len()).filter(stays).any(|other| is_left_by(*index, other));
        let left = among.iter().copied().filter(stays).filter(is_left);
        left.map(|index| (index, Reason::WaveOfFriction)).collect()
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
        let all: Vec<usize> = (0..self.added.len()).collect();
        let mut small = self.not_named(confirmation, &judged, &all);
        while let Some((index, reason)) = smallest(&judged, &small) {
            small.retain(|(other, _)| *other != index);
            // One without which nothing can be fitted stays.
            if !self.take_out(index, judged[index], reason) {
                continue;
            }
            told.remove(index);
            small.iter_mut().filter(|(other, _)| *other > index).for_each(|(other, _)| *other -= 1);
            if small.is_empty() {
                break;
            }
            let now;
            (now, judged) = self.judged();
            let among: Vec<usize> = small.iter().map(|(index, _)| *index).collect();
            let still = self.not_named(&now, &judged, &among);
            let is_still = |index: usize| still.iter().any(|(other, _)| *other == index);
            let named = small.iter().filter(|(index, _)| !is_still(*index));
            named.for_each(|(index, _)| told[*index] = judged[*index]);
            small = still;
        }
        told
    }

    /// Takes an effect out and refits the model; false where that cannot be fitted.
    pub fn take_out(&mut self, index: usize, judged: Judged, reason: Reason) -> bool {
        let Some((effect, model)) = self.without(index) else { return false };
        let removed = self.added.remove(index);
        let mut rivals = removed.rivals.into_iter().map(|rival| rival.effect);
        let rival = match reason {
            Reason::Rival => rivals.find(|rival| !effect.says_the_same_as(rival)),
            _ => None,
        };
        self.withheld.push(Withheld { effect, judged, reason, rival });
        self.last = if self.added.is_empty() { self.refitted.clone() } else { model };
        update_gains(self.subject, &self.refitted, &self.last, &mut self.added);
        true
    }

    /// Why an effect is of a model that is not this robot's, where it is.
    fn of_wrong_model(
        &self,
        confirmation: &Confirmation,
        effect: &EffectInstance,
    ) -> Option<Reason> {
        match self.is_plausible {
            false => Some(Reason::ImplausibleModel),
            true => self.is_anothers(confirmation, effect).then_some(Reason::AnotherRobot),
        }
    }

    /// Why an effect cannot be a cause at all: the model is not of this robot, or it is not what it says.
    fn cannot_be(&self, confirmation: &Confirmation, index: usize) -> Option<Reason> {
        let effect = &self.last.linear.hypothesis.effects[self.place(index)];
        let of_wrong_model = self.of_wrong_model(confirmation, effect);
        if of_wrong_model.is_some() {
            of_wrong_model
        } else if effect.is_spring() && confirmation.takes_noise(&self.last, effect) {
            Some(Reason::SpringNearNoise)
        } else if is_unsteady(&self.last, self.place(index)) {
            Some(Reason::Unsteady)
        } else if is_loose(&self.last, self.place(index)) {
            Some(Reason::LooseSpring)
        } else {
            is_by_lengths(self.subject, &self.added[index].without, effect)
                .then_some(Reason::Lengths)
        }
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
        let place = self.place(index);
        let effect = self.last.linear.hypothesis.effects[place].clone();
        Some((effect, without(self.subject, &self.refitted, &self.last, place)?))
    }

    /// Where an effect stands among those of the model, which may know some of its own.
    fn place(&self, index: usize) -> usize {
        self.subject.known_effects.len() + index
    }
}

/// The one of some effects, each with a reason, with which the least goes: without what others need they fall, too.
fn smallest(judged: &[Judged], among: &[(usize, Reason)]) -> Option<(usize, Reason)> {
    let share = |(index, _): &(usize, Reason)| judged[*index].share_with_it;
    among.iter().copied().min_by(|a, b| share(a).total_cmp(&share(b)))
}
