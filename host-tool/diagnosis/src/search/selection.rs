//! The search: effects are added to the model one after the other, each the best of all, as long
//! as the policy accepts one.

use super::finalists::finalists;
use super::fitted_model::FittedModel;
use super::policy::{improves, is_accepted, is_done, is_physical};
use super::restart::restarted;
use crate::fit::gauss_newton::fit;
use crate::fit::linearisation::Linearisation;
use crate::fit::preparation::as_given;
use crate::fit::residual_stats::ResidualStats;
use crate::logs::subject::Subject;
use crate::rows::evidence::Evidence;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};

/// The models of the search, and what was rejected.
pub struct Selection {
    /// The refitted model.
    pub refitted: FittedModel,
    /// The same with one effect more each.
    pub added: Vec<FittedModel>,
    /// Candidates that were not added, round after round, the best first.
    pub rejected: Vec<RejectedCandidate>,
}

/// A candidate that was not added.
#[derive(Clone, Debug)]
pub struct RejectedCandidate {
    /// The round in which it competed, from 0: for the place of `added[round]`, where that is there.
    pub round: usize,
    /// The effect, refitted with everything else.
    pub effect: EffectInstance,
    /// What the model leaves with it.
    pub stats: ResidualStats,
}

/// Adds effects to a refitted model; `progress` hears what is tried.
pub fn select(
    evidence: &Evidence,
    subject: &Subject,
    refitted: Linearisation,
    progress: &dyn Fn(&str),
) -> Selection {
    let refitted = FittedModel::of(evidence, refitted);
    let mut selection = Selection { refitted, added: Vec::new(), rejected: Vec::new() };
    for round in 0..evidence.criteria.selection.most_effects {
        progress(&format!("trying every effect on every joint, round {}", round + 1));
        let (gap, left) = (&selection.refitted.stats, &selection.last().stats);
        if is_done(gap, left, &evidence.criteria) {
            break;
        }
        match selection.best_addition(evidence, subject, round) {
            Some(model) => selection.added.push(model),
            None => break,
        }
    }
    progress("leaving out what is not needed");
    selection.pruned(evidence, subject)
}

impl Selection {
    /// The model with all effects that were added.
    pub fn last(&self) -> &FittedModel {
        self.added.last().unwrap_or(&self.refitted)
    }

    /// The model to which a round of the search, counted from 0, adds.
    pub fn before(&self, round: usize) -> &FittedModel {
        self.added[..round.min(self.added.len())].last().unwrap_or(&self.refitted)
    }

    /// The last model with the best effect that is accepted; the other finalists are rejected.
    fn best_addition(
        &mut self,
        evidence: &Evidence,
        subject: &Subject,
        round: usize,
    ) -> Option<FittedModel> {
        let before = self.last().stats.clone();
        let accepted = |model: &FittedModel| is_accepted(&before, model, &evidence.criteria);
        let start = with_given_parameters(evidence, subject, &self.last().linear)?;
        let mut finalists = finalists(evidence, subject, &start, &before);
        let best = finalists.iter().position(|finalist| accepted(&finalist.model));
        let best = best.map(|place| finalists.remove(place));
        self.rejected.extend(finalists.into_iter().map(|finalist| RejectedCandidate {
            round,
            effect: finalist.effect,
            stats: finalist.model.stats,
        }));
        let finished = finished(evidence, subject, best?.model);
        // The further fit may yet do worse on the rows held out, or leave what is physical.
        let effects = &finished.linear.hypothesis.effects;
        let physical = effects.iter().all(|effect| is_physical(effect, subject, evidence));
        (physical && accepted(&finished)).then_some(finished)
    }

    /// Without effects that others, added later, make needless: an offset goes once the spring
    /// is found that it stood for.
    fn pruned(mut self, evidence: &Evidence, subject: &Subject) -> Self {
        let known = subject.known_effects.len();
        let mut index = 0;
        while index + 1 < self.added.len() {
            let mut hypothesis = self.last().linear.hypothesis.clone();
            hypothesis.effects.remove(known + index);
            match fitted(evidence, subject, hypothesis) {
                Some(without)
                    if !improves(&without.stats, &self.last().stats, &evidence.criteria) =>
                {
                    self.leave_out(evidence, subject, index, without);
                }
                _ => index += 1,
            }
        }
        self
    }

    /// Takes an effect out of all models after it; `last` is the last of them.
    fn leave_out(
        &mut self,
        evidence: &Evidence,
        subject: &Subject,
        index: usize,
        last: FittedModel,
    ) {
        let known = subject.known_effects.len();
        self.added.truncate(index);
        for count in known + index + 1..last.linear.hypothesis.effects.len() {
            let mut hypothesis = last.linear.hypothesis.clone();
            hypothesis.effects.truncate(count);
            self.added.extend(fitted(evidence, subject, hypothesis));
        }
        self.added.push(last);
        self.rejected.retain(|rejected| rejected.round != index);
        for rejected in self.rejected.iter_mut().filter(|rejected| rejected.round > index) {
            rejected.round -= 1;
        }
    }
}

fn fitted(evidence: &Evidence, subject: &Subject, start: Hypothesis) -> Option<FittedModel> {
    let linear = fit(evidence, subject, start, evidence.criteria.selection.accepted_steps)?;
    Some(FittedModel::of(evidence, linear))
}

/// A model whose fit is carried on to its end.
fn finished(evidence: &Evidence, subject: &Subject, model: FittedModel) -> FittedModel {
    let policy = &evidence.criteria.selection;
    let spring = model.ends_with_spring();
    let steps = if spring { policy.accepted_spring_steps } else { policy.accepted_steps };
    let fitted = fit(evidence, subject, model.linear.hypothesis.clone(), steps);
    let mut best = fitted.map_or(model, |linear| FittedModel::of(evidence, linear));
    for _ in 0..evidence.criteria.search.restarts {
        match restarted(evidence, subject, &best) {
            Some(better) => best = better,
            None => break,
        }
    }
    best
}

/// The effects of a refitted model in the model as given. Effects are searched for from there,
/// because the refit absorbs part of an effect that is missing.
fn with_given_parameters(
    evidence: &Evidence,
    subject: &Subject,
    refitted: &Linearisation,
) -> Option<Linearisation> {
    let Hypothesis { effects, tables, .. } = refitted.hypothesis.clone();
    let hypothesis = Hypothesis { effects, tables, ..as_given(subject) };
    Linearisation::of(evidence, hypothesis, refitted.expected.clone())
}
