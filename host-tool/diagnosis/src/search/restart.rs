//! A better fit of backlash than the one that a search ended at.
//!
//! A link that bounces leaves many shallow minima: a wider gap with a stiffer spring does
//! nearly the same. The search restarts from near each of them.

use rayon::prelude::*;

use super::candidate::Candidate;
use super::policy::gain;
use crate::fit::fitted_model::FittedModel;
use crate::fit::gauss_newton::open_in;
use crate::fit::linearisation::Linearisation;
use crate::logs::subject::Subject;
use crate::trial::hypothesis::EffectInstance;

/// Factors of gap, stiffness, damping and the motor's inertia to restart with.
const RESTARTS: [[f64; 4]; 4] =
    [[1.15, 1.5, 1.0, 1.0], [0.87, 0.67, 1.0, 1.0], [1.0, 1.0, 0.7, 1.05], [1.1, 1.2, 0.7, 0.95]];

/// A model whose last effect, backlash, fits better than before; `None` where it is good, or
/// where nothing better is near.
pub fn restarted(subject: &Subject, step: &FittedModel) -> Option<FittedModel> {
    let (effort, evidence) = (&subject.criteria.search, &step.evidence);
    let backlash = step.linear.hypothesis.effects.last().filter(|effect| effect.has_backlash())?;
    if step.stats.worst() < effort.good_ratio {
        return None;
    }
    let mut hypothesis = step.linear.hypothesis.clone();
    hypothesis.effects.pop();
    let open = open_in(evidence, subject, &hypothesis.effects);
    let without = Linearisation::of(evidence, hypothesis, open)?;
    let here = Candidate::of(&without, evidence, backlash.clone()).0;
    let from = |factors: &[f64; 4]| {
        let values = backlash.values.iter().zip(factors).map(|(value, factor)| value * factor);
        let start = EffectInstance { values: values.collect(), ..backlash.clone() };
        let first = Candidate::of(&without, evidence, start).0;
        first.refined(&without, evidence, effort.restart_steps)
    };
    let best = RESTARTS
        .par_iter()
        .map(from)
        .min_by(|a, b| a.train.total_cmp(&b.train))
        .filter(|best| best.train < (1.0 - effort.least_restart_gain) * here.train)?;
    let hypothesis = without.hypothesis.with(best.effect);
    let steps = subject.criteria.selection.accepted_spring_steps;
    let better = FittedModel::fitted(evidence, subject, hypothesis, steps)?;
    (gain(step, &better) > 0.0).then_some(better)
}
