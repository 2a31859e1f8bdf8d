//! What the selection amounts to: effect, none or unknown, and how sure.

use crate::fit::residual_stats::ResidualStats;
use crate::logs::subject::Subject;
use crate::result::{Alternative, Verdict};
use crate::search::fitted_model::FittedModel;
use crate::search::selection::{Rivalry, Selection};
use crate::trial::hypothesis::EffectInstance;

/// A rest up to so many times the noise is explained, whatever the gap was.
const EXPLAINED_RATIO: f64 = 3.0;
/// So is one up to this part of the gap's.
const EXPLAINED_PART: f64 = 0.03;
/// The same where a spring lets motor or link bounce: how they move between samples is not
/// known, nor what friction does meanwhile.
const SPRUNG_RATIO: f64 = 6.0;
const SPRUNG_PART: f64 = 0.08;
/// Part of the gap's excess that the causes must take away.
const EXPLAINED_EXCESS: f64 = 0.9;
/// A gap up to so many times the noise that no effect explains is none.
const NO_GAP_RATIO: f64 = 2.0;
/// Independent pieces of evidence in a set of logs; neighbouring rows say the same.
const INDEPENDENT: f64 = 60.0;

/// The verdict on a selection.
pub fn verdict(selection: &Selection) -> Verdict {
    let (first, last) = (&selection.refitted, selection.last());
    let named = !selection.added.is_empty();
    match named {
        false if first.stats.excess == 0.0 || first.stats.worst() < NO_GAP_RATIO => Verdict::None,
        true if is_explained(first, last) => Verdict::Effect,
        _ => Verdict::Unknown,
    }
}

/// Whether what is left is as good as noise.
fn is_explained(gap: &FittedModel, last: &FittedModel) -> bool {
    let sprung = last.linear.hypothesis.effects.iter().any(EffectInstance::is_spring);
    let (ratio, part) = match sprung {
        true => (SPRUNG_RATIO, SPRUNG_PART),
        false => (EXPLAINED_RATIO, EXPLAINED_PART),
    };
    let (gap, rest) = (&gap.stats, &last.stats);
    let small = rest.worst() <= ratio.max(part * gap.worst());
    let believable = !rest.is_beyond_belief();
    believable && small && rest.excess <= (1.0 - EXPLAINED_EXCESS) * gap.excess
}

/// Part of the causes named without a rival that were right in blind trials
/// (docs/blind-trial.md): no verdict is surer than that.
const TRUST: f64 = 0.98;

/// How sure a cause is against its rivals, and those that are not ruled out.
pub fn confidence(
    selection: &Selection,
    round: usize,
    subject: &Subject,
) -> (f64, Vec<Alternative>) {
    let taken = &selection.added[round].stats;
    let rivals: Vec<(&Rivalry, f64)> = selection
        .rivals
        .iter()
        .filter(|rival| rival.round == round)
        .map(|rival| (rival, (-advantage(taken, &rival.stats)).exp()))
        .collect();
    let sum: f64 = 1.0 + rivals.iter().map(|rival| rival.1).sum::<f64>();
    let alternatives = rivals
        .iter()
        .map(|(rival, weight)| Alternative {
            effect: rival.candidate.effect.definition.name.into(),
            joint: subject.outer_joint(rival.candidate.effect.joint),
            confidence: weight / sum,
        })
        .filter(|alternative| alternative.confidence >= 0.02)
        .collect();
    (TRUST / sum, alternatives)
}

/// Log-likelihood by which a rest is better than another, on the joint where it is most so:
/// another effect that is still missing weighs on both alike. What retuning had to move
/// counts where the rows themselves are clean.
fn advantage(taken: &ResidualStats, rival: &ResidualStats) -> f64 {
    let by_joint = rival.rows_of.iter().zip(&taken.rows_of);
    let by_rows = by_joint
        .map(|(rival, taken)| 0.5 * INDEPENDENT * (rival / taken.max(1.0)).ln())
        .fold(f64::NEG_INFINITY, f64::max);
    let clean = taken.excess == 0.0 && rival.excess == 0.0;
    let by_misses = if clean { 0.125 * (rival.prior_penalty - taken.prior_penalty) } else { 0.0 };
    (by_rows + by_misses).clamp(-50.0, 50.0)
}
