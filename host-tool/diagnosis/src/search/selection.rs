//! The search: to a model and the effects that are known already others are added one after the other, each the
//! best of all, as long as the policy accepts one; then each is tried without, and against its rivals.

use std::collections::VecDeque;

use rayon::prelude::*;

use super::finalists::{Contest, each_once};
use super::found::{Added, KnownCauses, Rival, Selection};
use super::from_given::{better_from_given, is_chain, refitted_from_given, with_given_parameters};
use super::objection::objection_to;
use super::policy::{gain, is_done};
use super::refit::Finalist;
use super::runner_up::RunnerUp;
use super::winner::Winner;
use super::without::without;
use crate::fit::fitted_model::FittedModel;
use crate::logs::subject::Subject;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};

/// Adds effects to a refitted model, those that are known already first, unless something else `explains_all` that it
/// leaves, told by it and by the model so far; `progress` hears what is tried.
pub fn select(
    subject: &Subject,
    refitted: FittedModel,
    known: KnownCauses,
    explains_all: &dyn Fn(&FittedModel, &FittedModel) -> bool,
    progress: &dyn Fn(&str),
) -> Selection {
    let refitted = refitted_from_given(subject, refitted);
    let mut search = Search::of(subject, &refitted, refitted.clone(), Vec::new());
    search.begin_with(known);
    let mut refused = search.searched(0, &|last| explains_all(&refitted, last), progress);
    if refused.is_some()
        && let Some((further, others)) = search.by_systematic_misfit(progress)
    {
        (search, refused) = (further, others.or(refused));
    }
    progress("comparing each cause with its rivals");
    let added = search.compared();
    let refused = refused.map_or_else(Vec::new, |refused| refused.rivals(subject));
    let last = search.last;
    Selection { refitted, last, added, refused }
}

/// Candidates that were not accepted, and the model that they were tried in.
struct Refused {
    finalists: Vec<Finalist>,
    before: FittedModel,
}

impl Refused {
    fn rivals(self, subject: &Subject) -> Vec<Rival> {
        let rival = |finalist| Rival::refused(finalist, &self.before, subject);
        self.finalists.into_iter().map(rival).collect()
    }
}

/// How a round ends.
enum Round {
    /// An effect was added.
    Added,
    /// None was accepted of these.
    Refused(Vec<Finalist>),
}

/// The model so far, and what was tried in each round.
pub(super) struct Search<'a> {
    pub(super) subject: &'a Subject,
    /// The model without any of the effects.
    pub(super) refitted: &'a FittedModel,
    pub(super) last: FittedModel,
    /// What lost against each of the effects added.
    pub(super) rivals: Vec<Vec<EffectInstance>>,
    /// What the last round found on other joints than that of the effect that it added, the best first.
    runners_up: VecDeque<RunnerUp>,
}

impl<'a> Search<'a> {
    fn of(
        subject: &'a Subject,
        refitted: &'a FittedModel,
        last: FittedModel,
        rivals: Vec<Vec<EffectInstance>>,
    ) -> Self {
        Self { subject, refitted, last, rivals, runners_up: VecDeque::new() }
    }

    /// Adds effects as long as what is left asks for one, one is accepted, and nothing else explains it, and takes out
    /// those, from the place `first` on, that later ones make needless; what was refused in the end, where one was asked
    /// for.
    fn searched(
        &mut self,
        first: usize,
        is_explained: &dyn Fn(&FittedModel) -> bool,
        progress: &dyn Fn(&str),
    ) -> Option<Refused> {
        let finalists = self.rounds(is_explained, progress);
        // Rounds go on by independent rows where a fit to them was kept; what is found counts by what it leaves.
        if let Some(own) = self.last.clone().on_own_rows() {
            self.last = own;
        }
        let before = self.last.clone();
        self.prune(first);
        finalists.map(|finalists| Refused { finalists, before })
    }

    fn rounds(
        &mut self,
        is_explained: &dyn Fn(&FittedModel) -> bool,
        progress: &dyn Fn(&str),
    ) -> Option<Vec<Finalist>> {
        let criteria = &self.subject.criteria;
        for round in self.rivals.len()..criteria.selection.most_effects {
            let tried = if self.runners_up.is_empty() {
                "every effect on every joint"
            } else {
                "what came second"
            };
            progress(&format!("trying {tried}, round {}", round + 1));
            // Without effects it has been done already.
            if round > 0
                && is_chain(self.subject)
                && let Some(better) = better_from_given(self.subject, &self.last)
            {
                self.last = better;
            }
            if round > 0 && is_explained(&self.last) {
                return None;
            }
            // Before any is known all are tried: one may gain much where no log is left far above its noise.
            if round > 0 && is_done(&self.refitted.stats, &self.last.stats, criteria) {
                if self.last.stats.excess > 0.0 || !self.adds_sure_one() {
                    return None;
                }
                continue;
            }
            if let Round::Refused(finalists) = self.round() {
                return Some(finalists);
            }
        }
        None
    }

    /// Adds an effect where all logs are left near their noise, if it gains far more than any must; whether there was one.
    fn adds_sure_one(&mut self) -> bool {
        let policy = &self.subject.criteria.selection;
        let least = policy.sure_gain * policy.least_log_likelihood;
        self.runners_up.clear();
        let (last, rivals) = (self.last.clone(), self.rivals.clone());
        let is_sure = matches!(self.round(), Round::Added) && gain(&last, &self.last) > least;
        if !is_sure {
            (self.last, self.rivals) = (last, rivals);
        }
        is_sure
    }

    /// The search carried on with what is left taken to be systematic; none where that adds nothing.
    ///
    /// Once no effect pays, most of what is left is of friction that nobody's formula has. A log in which it
    /// looks white then holds the model as with a thousand rows, and another in which it lasts gives way: an
    /// effect that takes nearly all of that one does not pay for a hair's breadth of the first. Near the noise
    /// there is none of this.
    fn by_systematic_misfit(&self, progress: &dyn Fn(&str)) -> Option<(Self, Option<Refused>)> {
        if self.last.stats.worst() < self.subject.criteria.selection.systematic_ratio {
            return None;
        }
        progress("taking what is left to be systematic");
        let start = self.last.clone().taken_as_systematic(true);
        let last = start.on_own_rows()?.settled(self.subject);
        let rivals = self.rivals.clone();
        let mut further = Self::of(self.subject, self.refitted, last, rivals);
        // What paid by rows that all count is not taken out by rows of which few do.
        let refused = further.searched(self.rivals.len(), &|_| false, progress);
        (further.rivals.len() > self.rivals.len()).then_some((further, refused))
    }

    /// Adds the best effect that is accepted. Where there is none, what was refused.
    fn round(&mut self) -> Round {
        while let Some(runner_up) = self.runners_up.pop_front() {
            if let Some(winner) = runner_up.wins(self.subject, &self.last) {
                self.add(&winner.effect, winner.model, runner_up.rivals);
                return Round::Added;
            }
        }
        let Some(start) = with_given_parameters(self.subject, &self.last) else {
            return Round::Refused(Vec::new());
        };
        let mut contest = Contest::of(self.subject, &self.last, &start);
        let mut lost: Vec<EffectInstance> = Vec::new();
        while contest.advance() {
            if let Some(winner) =
                Winner::of(self.subject, &self.refitted.stats, &self.last, &mut contest, &lost)
            {
                let finalists = each_once(contest.finalists);
                let effect = &winner.effect;
                self.runners_up = RunnerUp::of(self.subject, &self.last, &finalists, effect).into();
                let others = finalists.into_iter().map(|finalist| finalist.effect);
                let others = others.filter(|other| !other.is_same_cause(effect));
                self.add(&winner.effect, winner.model, others.collect());
                return Round::Added;
            }
            lost = contest.finalists.iter().map(|finalist| finalist.effect.clone()).collect();
        }
        Round::Refused(each_once(contest.finalists))
    }

    /// Adds an effect that won over its rivals.
    fn add(&mut self, effect: &EffectInstance, finished: FittedModel, rivals: Vec<EffectInstance>) {
        let known = self.subject.known_effects.len();
        let before = &self.last.linear.hypothesis;
        if let Some(place) = before.spring_replaced_by(effect, known) {
            self.rivals.remove(place - known);
        }
        self.last = finished;
        self.rivals.push(rivals);
    }

    /// Takes out effects from the place `first` on that others, added later, make needless: an offset goes once
    /// the spring is found that it stood for.
    pub(super) fn prune(&mut self, first: usize) {
        let known = self.subject.known_effects.len();
        let mut index = first;
        while self.rivals.len() > 1 && index < self.rivals.len() {
            match self.without(known + index) {
                Some(without) if self.objects_to(known + index, &without) => {
                    self.last = without;
                    self.rivals.remove(index);
                }
                _ => index += 1,
            }
        }
    }

    /// Whether something speaks against the effect at this place, by what the model leaves without it.
    fn objects_to(&self, place: usize, without: &FittedModel) -> bool {
        let effect = &self.last.linear.hypothesis.effects[place];
        objection_to(Some(effect), without, &self.last, &self.subject.criteria).is_some()
    }

    /// The model without one of its effects, refitted.
    pub(super) fn without(&self, index: usize) -> Option<FittedModel> {
        without(self.subject, self.refitted, &self.last, index)
    }

    pub(super) fn fitted(&self, hypothesis: Hypothesis) -> Option<FittedModel> {
        let steps = self.subject.criteria.selection.accepted_steps;
        let FittedModel { linear, evidence, .. } = &self.last;
        FittedModel::fitted_near(linear, evidence, self.subject, hypothesis, steps)
    }
}

/// Brings up to date what each effect gains, in a model that holds just these.
pub fn update_gains(
    subject: &Subject,
    refitted: &FittedModel,
    last: &FittedModel,
    added: &mut [Added],
) {
    let known = subject.known_effects.len();
    let update = |(index, added): (usize, &mut Added)| {
        if let Some(without) = without(subject, refitted, last, known + index) {
            added.gain = gain(&without, last);
            added.without = without;
        }
    };
    added.par_iter_mut().enumerate().for_each(update);
}
