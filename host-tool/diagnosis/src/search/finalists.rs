//! The best candidates, refitted together with everything else in the model.

use rayon::prelude::*;

use super::candidate::{Candidate, ScoredCandidate};
use super::candidates::{Start, candidates, places_open, starts};
use super::fitted_model::FittedModel;
use super::policy::{is_accepted, is_physical};
use crate::fit::gauss_newton::fit;
use crate::fit::linearisation::Linearisation;
use crate::fit::residual_stats::ResidualStats;
use crate::logs::subject::Subject;
use crate::rows::evidence::Evidence;
use crate::trial::hypothesis::EffectInstance;
use rig::effects::Definition;

/// A candidate that is refitted with everything else.
pub struct Finalist {
    /// The effect with its values after that.
    pub effect: EffectInstance,
    /// The model with it.
    pub model: FittedModel,
}

/// The finalists, the best first: of candidates that promise most, and where none of them keeps
/// its promise and is accepted, of those that promise less.
pub fn finalists(
    evidence: &Evidence,
    subject: &Subject,
    now: &Linearisation,
    before: &ResidualStats,
) -> Vec<Finalist> {
    let total = now.score().total();
    let mut promising = candidates(now, evidence, subject);
    promising.retain(|candidate| candidate.score.total() < total);
    let mut finalists = Vec::new();
    let one_is_accepted = |finalists: &[Finalist]| {
        finalists.iter().any(|finalist| is_accepted(before, &finalist.model, &evidence.criteria))
    };
    for _ in 0..evidence.criteria.selection.batches {
        let batch = next_batch(&mut promising, total, evidence);
        finalists.extend(refitted(evidence, subject, now, batch));
        if promising.is_empty() || one_is_accepted(&finalists) {
            break;
        }
    }
    if !one_is_accepted(&finalists) {
        let batch = overlooked(evidence, subject, now, &finalists);
        finalists.extend(refitted(evidence, subject, now, batch));
    }
    finalists.sort_by(|a, b| a.model.total().total_cmp(&b.model.total()));
    finalists
}

/// Effects that were not searched because others promised more than they kept.
fn overlooked(
    evidence: &Evidence,
    subject: &Subject,
    now: &Linearisation,
    tried: &[Finalist],
) -> Vec<ScoredCandidate> {
    let effort = &evidence.criteria.search;
    let is_new = |place: &(&'static Definition, u8)| {
        let same =
            |f: &Finalist| (f.effect.definition.name, f.effect.joint) == (place.0.name, place.1);
        !tried.iter().any(same)
    };
    let first = |(definition, joint): (&'static Definition, u8)| {
        starts(now, evidence, subject, definition, joint).into_iter().next()
    };
    let places: Vec<(&'static Definition, u8)> =
        places_open(subject, &now.hypothesis.effects).into_iter().filter(is_new).collect();
    let mut promising: Vec<Start> = places.into_par_iter().filter_map(first).collect();
    promising.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    promising.truncate(effort.overlooked);
    let searched = |start: Start| {
        let begin = Candidate::of(now, evidence, start.effect).0;
        begin.refined(now, evidence, effort.overlooked_steps).scored(now, evidence)
    };
    let mut found: Vec<ScoredCandidate> = promising.into_par_iter().map(searched).collect();
    found.sort_by(|a, b| a.score.total().total_cmp(&b.score.total()));
    found.truncate(evidence.criteria.selection.finalists);
    found
}

/// Takes the best of those that are left, and those that promise nearly as much.
fn next_batch(
    promising: &mut Vec<ScoredCandidate>,
    total: f64,
    evidence: &Evidence,
) -> Vec<ScoredCandidate> {
    let policy = &evidence.criteria.selection;
    let gain = |candidate: &ScoredCandidate| total - candidate.score.total();
    let least = policy.finalist_gain * promising.first().map_or(0.0, gain);
    let alike = promising.iter().take_while(|candidate| gain(candidate) > least).count();
    promising.drain(..alike.clamp(1, policy.finalists).min(promising.len())).collect()
}

fn refitted(
    evidence: &Evidence,
    subject: &Subject,
    now: &Linearisation,
    batch: Vec<ScoredCandidate>,
) -> Vec<Finalist> {
    let refit = |candidate: ScoredCandidate| {
        let start = now.hypothesis.with(candidate.effect);
        let steps = evidence.criteria.selection.finalist_steps;
        let model = FittedModel::of(evidence, fit(evidence, subject, start, steps)?);
        let effect = model.linear.hypothesis.effects.last()?.clone();
        is_physical(&effect, subject, evidence).then_some(Finalist { effect, model })
    };
    batch.into_par_iter().filter_map(refit).collect()
}
