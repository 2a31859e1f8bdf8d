//! What the search amounts to: effect, none or unknown, and how sure.

use crate::criteria::Criteria;
use crate::fit::residual_stats::ResidualStats;
use crate::logs::subject::Subject;
use crate::result::{Alternative, Verdict};
use crate::search::fitted_model::FittedModel;
use crate::search::selection::{RejectedCandidate, Selection};
use crate::trial::hypothesis::EffectInstance;

/// The verdict on a selection.
pub fn verdict(selection: &Selection, criteria: &Criteria) -> Verdict {
    let gap = &selection.refitted.stats;
    let no_gap = gap.excess == 0.0 || gap.worst() < criteria.verdict.no_gap_ratio;
    match selection.added.last() {
        None if no_gap => Verdict::None,
        Some(last) if is_explained(gap, last, criteria) => Verdict::Effect,
        _ => Verdict::Unknown,
    }
}

/// Whether what is left is as good as noise.
fn is_explained(gap: &ResidualStats, last: &FittedModel, criteria: &Criteria) -> bool {
    let bounds = &criteria.verdict;
    let with_spring = last.linear.hypothesis.effects.iter().any(EffectInstance::is_spring);
    let (ratio, part) = match with_spring {
        true => (bounds.explained_spring_ratio, bounds.explained_spring_part),
        false => (bounds.explained_ratio, bounds.explained_part),
    };
    let left = &last.stats;
    !left.is_implausible(&criteria.fit)
        && left.worst() <= ratio.max(part * gap.worst())
        && left.excess <= (1.0 - bounds.explained_excess) * gap.excess
}

/// How sure a cause is against the candidates that were rejected for it, and those of them that
/// are not ruled out.
pub fn confidence(
    selection: &Selection,
    round: usize,
    subject: &Subject,
) -> (f64, Vec<Alternative>) {
    let bounds = &subject.criteria.verdict;
    let added = &selection.added[round].stats;
    let likelihood = |rejected: &RejectedCandidate| {
        let independent = bounds.independent_observations;
        (-advantage(added, &rejected.stats, independent, bounds.prior_weight)).exp()
    };
    let of_round = selection.rejected.iter().filter(|rejected| rejected.round == round);
    let rivals: Vec<(&RejectedCandidate, f64)> =
        of_round.map(|rejected| (rejected, likelihood(rejected))).collect();
    let sum: f64 = 1.0 + rivals.iter().map(|rival| rival.1).sum::<f64>();
    let alternatives = rivals
        .iter()
        .map(|(rival, likelihood)| Alternative {
            effect: rival.effect.definition.name.into(),
            joint: subject.outer_joint(rival.effect.joint),
            confidence: likelihood / sum,
        })
        .filter(|alternative| alternative.confidence >= bounds.least_confidence)
        .collect();
    (bounds.highest_confidence / sum, alternatives)
}

/// Log-likelihood by which an effect is better than another, on the joint where it is most so:
/// a third one that is still missing weighs on both alike. The prior penalty counts where the
/// rows themselves are as good as noise.
fn advantage(
    added: &ResidualStats,
    rival: &ResidualStats,
    independent: f64,
    prior_weight: f64,
) -> f64 {
    let by_joint = rival.squares_by_joint.iter().zip(&added.squares_by_joint);
    let by_rows = by_joint
        .map(|(rival, added)| 0.5 * independent * (rival / added.max(1.0)).ln())
        .fold(f64::NEG_INFINITY, f64::max);
    let clean = added.excess == 0.0 && rival.excess == 0.0;
    let by_prior =
        if clean { prior_weight * (rival.prior_penalty - added.prior_penalty) } else { 0.0 };
    (by_rows + by_prior).clamp(-50.0, 50.0)
}
