//! Candidates sought, and refitted at first, as if every row said something of its own.
//!
//! What a model leaves while several causes are missing lasts long and is largest in one log; rows that say
//! the same count as one, and each by how much is left there. That log then has hardly a say in what is
//! sought: a cause that would take most of it promises little, and a fit that starts with it goes back.
//! Weights that follow what is left have several minima, as in robust regression, and need several starts:
//! rows that all count, by what is left of their log, and rows that all count alike. Whether a candidate pays is
//! judged by what it leaves then itself, like that of any other finalist.

use rayon::prelude::*;

use super::candidate::Candidate;
use super::candidates::candidates;
use super::refit::{Finalist, refitted, refitted_from};
use super::starts::{EffectStarts, is_spring};
use crate::fit::fitted_model::FittedModel;
use crate::fit::linearisation::Linearisation;
use crate::logs::subject::Subject;
use crate::rows::evidence::Evidence;

/// The weights from which a search or a fit may begin: rows of the size that the model leaves of each log, then of the
/// size that a joint's rows have together, each for itself; none where hardly any rows say the same (`lasting_rows`).
fn starting_weights(subject: &Subject, model: &FittedModel) -> Vec<Evidence> {
    let misfit = model.misfit();
    if misfit.longest_correlation() < subject.criteria.search.lasting_rows {
        return Vec::new();
    }
    let own = misfit.clone().independent();
    let pooled = own.clone().pooled();
    [own, pooled].iter().map(|misfit| misfit.weigh(&model.evidence)).collect()
}

/// Rows each for itself, and a model linearised on them.
struct IndependentRows {
    evidence: Evidence,
    linear: Linearisation,
}

impl IndependentRows {
    /// Those of what the model `before` leaves, for the same model as it is in `now`, by the slopes that it has there.
    fn starts(subject: &Subject, before: &FittedModel, now: &Linearisation) -> Vec<Self> {
        let on = |evidence: Evidence| {
            let linear = now.reweighted(&before.evidence, &evidence)?;
            Some(Self { evidence, linear })
        };
        starting_weights(subject, before).into_par_iter().filter_map(on).collect()
    }

    /// The best candidates. Springs between motor and link are not among them: they smooth, and take some of
    /// whatever is left.
    fn candidates(
        &self,
        subject: &Subject,
        from: &Evidence,
        tried: &[EffectStarts],
    ) -> Vec<Candidate> {
        let here = (&self.linear, &self.evidence);
        let starts = |tried: &EffectStarts| tried.on(from, here, subject).best(subject);
        let others = tried.par_iter().filter(|tried| !is_spring(tried.definition));
        let starts = others.map(starts).collect();
        let mut found = candidates(starts, &self.linear, &self.evidence, subject);
        let without = self.linear.refitted_objective();
        found.retain(|candidate| candidate.train < without);
        found.truncate(subject.criteria.search.by_independent_rows);
        found
    }
}

/// The best effects beside those of the model `before`, sought from where it is linearised in `now`, refitted; of starts
/// that were `tried` there.
pub(super) fn by_independent_rows(
    subject: &Subject,
    before: &FittedModel,
    now: &Linearisation,
    tried: &[EffectStarts],
) -> Vec<Finalist> {
    let starts = IndependentRows::starts(subject, before, now);
    let Some(first) = starts.first() else { return Vec::new() };
    let found = first.candidates(subject, &before.evidence, tried);
    let from = |rows: &IndependentRows| {
        refitted_from(subject, before, (&rows.evidence, &rows.linear), &found)
    };
    let mut all: Vec<Finalist> = starts.par_iter().flat_map(from).collect();
    all.extend(refitted(subject, before, now, found));
    all
}

/// A model fitted anew as if every row said something of its own, then by what it leaves, from the best of
/// these starts; none where hardly any rows say the same.
pub fn fitted_by_independent_rows(
    subject: &Subject,
    model: &FittedModel,
    steps: usize,
) -> Option<FittedModel> {
    let fitted = |evidence: Evidence| {
        let start = model.linear.hypothesis.clone();
        FittedModel::fitted(&evidence, subject, start, steps)
    };
    let weights = starting_weights(subject, model);
    let all: Vec<FittedModel> = weights.into_par_iter().filter_map(fitted).collect();
    let best = all.into_iter().reduce(FittedModel::better_of);
    best.map(|best| best.settled(subject))
}
