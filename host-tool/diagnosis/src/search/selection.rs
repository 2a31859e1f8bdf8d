//! The search: effects are added to the model one after the other, each the best of all, as long
//! as the policy accepts one; then each is tried without, and against its rivals.

use super::finalists::Contest;
use super::found::{Added, Rival, Selection};
use super::independent_rows::fitted_by_independent_rows;
use super::objection::objection;
use super::policy::{gain, is_done, is_physical};
use super::refit::Finalist;
use super::restart::{restarted, with_play};
use crate::fit::fitted_model::FittedModel;
use crate::fit::linearisation::Linearisation;
use crate::fit::preparation::as_given;
use crate::fit::unknowns::kept_physical;
use crate::logs::subject::Subject;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};

/// Adds effects to a refitted model, those that are known already first; `progress` hears what is tried.
pub fn select(
    subject: &Subject,
    refitted: FittedModel,
    known: &[EffectInstance],
    progress: &dyn Fn(&str),
) -> Selection {
    let mut search = Search { subject, last: refitted.clone(), rivals: Vec::new() };
    known.iter().for_each(|effect| search.add_known(effect));
    let mut refused = Vec::new();
    for round in 0..subject.criteria.selection.most_effects {
        progress(&format!("trying every effect on every joint, round {}", round + 1));
        if is_done(&refitted.stats, &search.last.stats, &subject.criteria) {
            break;
        }
        match search.round() {
            Round::Added => {}
            Round::Refused(finalists) => {
                refused = finalists;
                break;
            }
        }
    }
    let before = search.last.clone();
    progress("comparing each cause with its rivals");
    search.prune();
    let added = search.compared();
    let refused =
        refused.into_iter().map(|finalist| Rival::refused(finalist, &before, subject)).collect();
    Selection { refitted, last: search.last, added, refused }
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
    pub(super) last: FittedModel,
    /// Finalists that lost against each of the effects added.
    pub(super) rivals: Vec<Vec<Finalist>>,
}

impl Search<'_> {
    /// Adds the best effect that is accepted. Where there is none, what was refused.
    fn round(&mut self) -> Round {
        let Some(start) = with_given_parameters(self.subject, &self.last) else {
            return Round::Refused(Vec::new());
        };
        let mut contest = Contest::of(self.subject, &self.last, &start);
        let mut lost: Vec<EffectInstance> = Vec::new();
        while contest.advance() {
            let mut won = self.winner(&contest.finalists, &lost);
            if won.as_ref().is_none_or(|(_, model)| self.leaves_much(model)) && contest.widen() {
                won = self.better_winner(&contest.finalists, &lost, won);
            }
            if let Some((effect, finished)) = won {
                let mut rivals = contest.finalists;
                rivals.retain(|finalist| !finalist.effect.is_same_cause(&effect));
                self.add(&effect, finished, rivals);
                return Round::Added;
            }
            lost = contest.finalists.iter().map(|finalist| finalist.effect.clone()).collect();
        }
        Round::Refused(contest.finalists)
    }

    /// The best finalist that is accepted, of those that have not lost yet, its fit carried on to its end.
    fn winner(
        &self,
        finalists: &[Finalist],
        lost: &[EffectInstance],
    ) -> Option<(EffectInstance, FittedModel)> {
        let mut open = finalists.iter().filter(|finalist| !lost.contains(&finalist.effect));
        open.find_map(|best| Some((best.effect.clone(), self.finished_and_accepted(best)?)))
    }

    /// The best of more finalists, among which the winner so far is; that one where it is still the first.
    fn better_winner(
        &self,
        finalists: &[Finalist],
        lost: &[EffectInstance],
        won: Option<(EffectInstance, FittedModel)>,
    ) -> Option<(EffectInstance, FittedModel)> {
        let is_first = |(effect, _): &(EffectInstance, FittedModel)| {
            finalists.first().is_some_and(|first| first.effect == *effect)
        };
        if won.as_ref().is_some_and(is_first) {
            return won;
        }
        let now = self.winner(finalists, lost);
        let gains_more = |(_, model): &(EffectInstance, FittedModel)| {
            won.as_ref().is_none_or(|(_, so_far)| model.gain_over(so_far) > 0.0)
        };
        if now.as_ref().is_some_and(gains_more) { now } else { won }
    }

    /// Whether a model leaves what asks for another effect.
    fn leaves_much(&self, model: &FittedModel) -> bool {
        !is_done(&self.last.stats, &model.stats, &self.subject.criteria)
    }

    /// Adds an effect with the values that it is known by, if it is accepted.
    fn add_known(&mut self, effect: &EffectInstance) {
        let hypothesis = self.last.linear.hypothesis.clone().with(effect.clone());
        let with = self.fitted(hypothesis).map(|with| with.settled(self.subject));
        let accepted =
            |with: &FittedModel| objection(&self.last, with, &self.subject.criteria).is_none();
        if let Some(with) = with.filter(accepted) {
            self.add(effect, with, Vec::new());
        }
    }

    /// Adds an effect that won over its rivals.
    fn add(&mut self, effect: &EffectInstance, finished: FittedModel, rivals: Vec<Finalist>) {
        let known = self.subject.known_effects.len();
        let before = &self.last.linear.hypothesis;
        if let Some(place) = before.spring_replaced_by(effect, known) {
            self.rivals.remove(place - known);
        }
        self.last = finished;
        self.rivals.push(rivals);
    }

    /// A finalist whose fit is carried on to its end, if it is accepted before and after that, and
    /// is still physical: the further fit may yet leave that.
    fn finished_and_accepted(&self, finalist: &Finalist) -> Option<FittedModel> {
        let accepted =
            |model: &FittedModel| objection(&self.last, model, &self.subject.criteria).is_none();
        let finished =
            accepted(&finalist.model).then(|| finished(self.subject, finalist.model.clone()))?;
        (is_all_physical(self.subject, &finished) && accepted(&finished)).then_some(finished)
    }

    /// Takes out effects that others, added later, make needless: an offset goes once the spring
    /// is found that it stood for.
    fn prune(&mut self) {
        let known = self.subject.known_effects.len();
        let mut index = 0;
        while self.rivals.len() > 1 && index < self.rivals.len() {
            match self.without(known + index) {
                Some(without)
                    if objection(&without, &self.last, &self.subject.criteria).is_some() =>
                {
                    self.last = without;
                    self.rivals.remove(index);
                }
                _ => index += 1,
            }
        }
    }

    /// The model without one of its effects, refitted.
    pub(super) fn without(&self, index: usize) -> Option<FittedModel> {
        let mut hypothesis = self.last.linear.hypothesis.clone();
        hypothesis.effects.remove(index);
        self.fitted(hypothesis)
    }

    pub(super) fn fitted(&self, hypothesis: Hypothesis) -> Option<FittedModel> {
        let steps = self.subject.criteria.selection.accepted_steps;
        let FittedModel { linear, evidence, .. } = &self.last;
        FittedModel::fitted_near(linear, evidence, self.subject, hypothesis, steps)
    }
}

/// Brings up to date what each effect gains, in a model that holds just these.
pub fn update_gains(subject: &Subject, last: &FittedModel, added: &mut [Added]) {
    let known = subject.known_effects.len();
    let search = Search { subject, last: last.clone(), rivals: Vec::new() };
    for (index, added) in added.iter_mut().enumerate() {
        if let Some(without) = search.without(known + index) {
            added.gain = gain(&without, last);
            added.without = without;
        }
    }
}

/// A model whose fit is carried on to its end, where it gains by that.
fn finished(subject: &Subject, model: FittedModel) -> FittedModel {
    let policy = &subject.criteria.selection;
    let spring = model.ends_with_spring();
    let steps = if spring { policy.accepted_spring_steps } else { policy.accepted_steps };
    let hypothesis = model.linear.hypothesis.clone();
    let further = FittedModel::fitted(&model.evidence, subject, hypothesis, steps);
    let mut best = further.filter(|further| further.gain_over(&model) > 0.0).unwrap_or(model);
    // Play so narrow that it is none would only fit better what the spring explains.
    let play = with_play(subject, &best).filter(|play| is_all_physical(subject, play));
    best = play.unwrap_or(best);
    best = best.settled(subject);
    let anew = fitted_by_independent_rows(subject, &best, steps);
    let is_better =
        |anew: &FittedModel| anew.gain_over(&best) > 0.0 && is_all_physical(subject, anew);
    best = anew.filter(is_better).unwrap_or(best);
    for _ in 0..subject.criteria.search.restarts {
        match restarted(subject, &best) {
            Some(better) => best = better,
            None => break,
        }
    }
    best
}

/// Whether all effects of a model are physical.
fn is_all_physical(subject: &Subject, model: &FittedModel) -> bool {
    let mut effects = model.linear.hypothesis.effects.iter();
    effects.all(|effect| is_physical(effect, subject, &model.evidence))
}

/// The effects of a refitted model in the model as given. Effects are searched for from there,
/// because the refit absorbs part of an effect that is missing; what shapes friction around
/// standstill stays as it was refitted, for there nothing hides.
fn with_given_parameters(subject: &Subject, refitted: &FittedModel) -> Option<Linearisation> {
    let Linearisation { hypothesis, expected, .. } = &refitted.linear;
    let (effects, tables) = (hypothesis.effects.clone(), hypothesis.tables.clone());
    let mut start = Hypothesis { effects, tables, ..as_given(subject) };
    for expected in expected.iter().filter(|expected| expected.unknown.shapes_friction()) {
        expected.unknown.set(&mut start, expected.unknown.get(hypothesis));
    }
    kept_physical(&mut start, subject);
    Linearisation::of(&refitted.evidence, start, expected.clone())
}
