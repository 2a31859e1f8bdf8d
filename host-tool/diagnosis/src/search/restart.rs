//! A better fit of play than the one that a search ended at.
//!
//! A link that bounces leaves many shallow minima: a wider gap with a stiffer spring does
//! nearly the same. From near each of them the search begins anew.

use rayon::prelude::*;

use super::candidate::Candidate;
use super::fitted_model::{FittedModel, SPRING_STEPS};
use crate::fit::gauss_newton::{fit, open_in};
use crate::fit::linearisation::{Linearisation, Which};
use crate::logs::subject::Subject;
use crate::rows::evidence::Evidence;
use crate::trial::hypothesis::EffectInstance;

/// Factors of gap, stiffness, damping and the motor's inertia to begin anew with.
const RESTARTS: [[f64; 4]; 4] =
    [[1.15, 1.5, 1.0, 1.0], [0.87, 0.67, 1.0, 1.0], [1.0, 1.0, 0.7, 1.05], [1.1, 1.2, 0.7, 0.95]];
/// Part of the squares that a new beginning must gain to be worth it.
const WORTH_IT: f64 = 0.05;
/// What is left when nothing need be restarted, over noise.
const GOOD_RATIO: f64 = 3.0;
const STEPS: usize = 8;

/// A model whose last effect, play, fits better than before; `None` where it is good, or
/// where nothing better is near.
pub fn restarted(
    evidence: &Evidence,
    subject: &Subject,
    step: &FittedModel,
) -> Option<FittedModel> {
    let play = step.linear.hypothesis.effects.last().filter(|effect| effect.has_backlash())?;
    if step.stats.worst() < GOOD_RATIO {
        return None;
    }
    let mut hypothesis = step.linear.hypothesis.clone();
    hypothesis.effects.pop();
    let open = open_in(evidence, subject, &hypothesis.effects);
    let without = Linearisation::of(evidence, hypothesis, open)?;
    let here = Candidate::of(&without, evidence, play.clone(), Which::TRAIN).0;
    let from = |factors: &[f64; 4]| {
        let values = play.values.iter().zip(factors).map(|(value, factor)| value * factor);
        let start = EffectInstance { values: values.collect(), ..play.clone() };
        let begun = Candidate::of(&without, evidence, start, Which::TRAIN).0;
        begun.refined(&without, evidence, STEPS, Which::TRAIN)
    };
    let best = RESTARTS
        .par_iter()
        .map(from)
        .min_by(|a, b| a.score.train.total_cmp(&b.score.train))
        .filter(|best| best.score.train < (1.0 - WORTH_IT) * here.score.train)?;
    let hypothesis = without.hypothesis.with(best.effect);
    let better = FittedModel::of(evidence, fit(evidence, subject, hypothesis, SPRING_STEPS)?);
    (better.linear.objective < step.linear.objective).then_some(better)
}
