//! The finalist that is accepted, its fit carried on to its end.

use super::finalists::Contest;
use super::independent_rows::fitted_by_independent_rows;
use super::objection::objection;
use super::policy::{is_done, is_physical, may_be_done};
use super::refit::Finalist;
use super::restart::{restarted, with_play};
use crate::fit::fitted_model::FittedModel;
use crate::fit::residual_stats::ResidualStats;
use crate::logs::subject::Subject;
use crate::trial::hypothesis::EffectInstance;

/// A finalist that is accepted.
pub struct Winner {
    /// Its effect, as the contest found it.
    pub effect: EffectInstance,
    /// The model with it, fitted to the end.
    pub model: FittedModel,
}

impl Winner {
    /// That of a contest for a place beside the effects of the model `before`, of those that have not `lost`
    /// yet; the contest is widened unless the first leaves no more of the `gap` than ends a search.
    pub fn of(
        subject: &Subject,
        gap: &ResidualStats,
        before: &FittedModel,
        contest: &mut Contest,
        lost: &[EffectInstance],
    ) -> Option<Self> {
        let criteria = &subject.criteria;
        let may_end = |finalist: &Finalist| may_be_done(gap, &finalist.model);
        if !contest.finalists.iter().any(may_end) {
            // Whoever wins leaves much: it is told once all are there.
            contest.widen();
            return Self::among(subject, before, &contest.finalists, lost);
        }
        let first = Self::among(subject, before, &contest.finalists, lost);
        let is_all = |winner: &Self| is_done(gap, &winner.model.stats, criteria);
        let tried: Vec<EffectInstance> =
            contest.finalists.iter().map(|finalist| finalist.effect.clone()).collect();
        if first.as_ref().is_some_and(is_all) || !contest.widen() {
            return first;
        }
        let place =
            |winner: &Self| contest.finalists.iter().position(|f| f.effect == winner.effect);
        let before_it = first.as_ref().and_then(place).unwrap_or(contest.finalists.len());
        Self::among(subject, before, &contest.finalists[..before_it], &tried).or(first)
    }

    /// The best that is accepted.
    fn among(
        subject: &Subject,
        before: &FittedModel,
        finalists: &[Finalist],
        lost: &[EffectInstance],
    ) -> Option<Self> {
        let mut open = finalists.iter().filter(|finalist| !lost.contains(&finalist.effect));
        open.find_map(|best| {
            let model = finished_and_accepted(subject, before, best)?;
            Some(Self { effect: best.effect.clone(), model })
        })
    }
}

/// A finalist whose fit is carried on to its end, if it is accepted before and after that, and
/// is still physical: the further fit may yet leave that.
pub(super) fn finished_and_accepted(
    subject: &Subject,
    before: &FittedModel,
    finalist: &Finalist,
) -> Option<FittedModel> {
    let accepted = |model: &FittedModel| objection(before, model, &subject.criteria).is_none();
    let finished = accepted(&finalist.model).then(|| finished(subject, finalist.model.clone()))?;
    (is_all_physical(subject, &finished) && accepted(&finished)).then_some(finished)
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
    best = play.unwrap_or(best).settled(subject);
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

/// Whether all effects of a model are physical; those that the model as given holds are taken as they are.
pub(super) fn is_all_physical(subject: &Subject, model: &FittedModel) -> bool {
    let mut effects = model.linear.hypothesis.effects.iter().skip(subject.known_effects.len());
    effects.all(|effect| is_physical(effect, subject, &model.evidence))
}
