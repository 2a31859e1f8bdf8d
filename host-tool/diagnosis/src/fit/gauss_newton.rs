//! Fits of a model to the train logs: Gauss-Newton steps with a prior.

use super::linearisation::{Linearisation, objective};
use super::unknowns::{Expected, Unknown, expected, kept_physical};
use crate::logs::subject::Subject;
use crate::rows::evidence::Evidence;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};
use crate::trial::residual_rows::residual_rows;
use rig::effects::Kind;

/// Fits a model with everything open in it; `None` where the numbers do not work out.
pub fn fit(
    evidence: &Evidence,
    subject: &Subject,
    start: Hypothesis,
    most_steps: usize,
) -> Option<Linearisation> {
    let open = open_in(evidence, subject, &start.effects);
    let mut best = Linearisation::of(evidence, start, open.clone())?;
    for _ in 0..most_steps {
        let Some((next, objective)) = improved(evidence, subject, &best, &open) else { break };
        let gain = best.objective - objective;
        best = Linearisation::of(evidence, next, open.clone())?;
        if gain < subject.criteria.fit.converged_part * best.objective {
            break;
        }
    }
    Some(best)
}

/// The fit with base parameters, Coulomb and viscous friction and lags no further than
/// a few deviations from what is known of them.
pub fn fit_held(
    evidence: &Evidence,
    subject: &Subject,
    start: Hypothesis,
) -> Option<Linearisation> {
    let mut open = open_in(evidence, subject, &start.effects);
    let mut hypothesis = start;
    let within = subject.criteria.fit.within_deviations;
    for _ in 0..subject.criteria.fit.bound_rounds {
        hold(&mut open, &mut hypothesis, within);
        let linear = Linearisation::of(evidence, hypothesis.clone(), open.clone())?;
        let better = improved(evidence, subject, &linear, &open);
        hypothesis = better.map_or(linear.hypothesis, |(hypothesis, _)| hypothesis);
    }
    hold(&mut open, &mut hypothesis, within);
    Linearisation::of(evidence, hypothesis, open)
}

/// Fixes what lies more than `within` deviations off there.
fn hold(open: &mut [Expected], hypothesis: &mut Hypothesis, within: f64) {
    const FIXED: f64 = 1e-3;
    for expected in open {
        let deviations = (expected.unknown.get(hypothesis) - expected.mean) / expected.deviation;
        let is_effect = matches!(expected.unknown, Unknown::Effect { .. });
        let may_be_held = !is_effect && !expected.unknown.shapes_friction();
        if may_be_held && deviations.abs() > within {
            expected.mean += within * expected.deviation * deviations.signum();
            expected.deviation *= FIXED;
            expected.unknown.set(hypothesis, expected.mean);
        }
    }
}

/// A better hypothesis along the step with its objective, or none.
fn improved(
    evidence: &Evidence,
    subject: &Subject,
    best: &Linearisation,
    open: &[Expected],
) -> Option<(Hypothesis, f64)> {
    let step = best.step();
    [1.0, 0.5, 0.2, 0.05].into_iter().find_map(|part| {
        let mut hypothesis = best.moved(&step, part);
        kept_physical(&mut hypothesis, subject);
        for effect in &mut hypothesis.effects {
            effect.normalise();
        }
        let objective = objective_of(evidence, &hypothesis, open);
        (objective < best.objective).then_some((hypothesis, objective))
    })
}

fn objective_of(evidence: &Evidence, hypothesis: &Hypothesis, open: &[Expected]) -> f64 {
    let residual = residual_rows(evidence, hypothesis);
    let train = [0, 1, 2].map(|joint| evidence.train_rows(joint));
    objective(&residual, &train, hypothesis, open)
}

/// Everything open in a model with these effects.
pub fn open_in(
    evidence: &Evidence,
    subject: &Subject,
    effects: &[EffectInstance],
) -> Vec<Expected> {
    let period_s = evidence.stretches[0].period_s;
    let mut open = expected(subject, period_s);
    for (index, effect) in effects.iter().enumerate().skip(subject.known_effects.len()) {
        for (value, parameter) in effect.definition.parameters.iter().enumerate() {
            if parameter.kind == Kind::Harmonic {
                continue;
            }
            let unknown = Unknown::Effect { index, value };
            // So wide that it only keeps what the logs do not tell where it is.
            let deviation = 0.5 * (parameter.highest - parameter.lowest);
            open.push(Expected { unknown, mean: effect.values[value], deviation });
        }
    }
    open
}
