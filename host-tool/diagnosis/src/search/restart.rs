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
use rig::effects::{Definition, Kind, Parameter};

/// Factors of gap, stiffness, damping and the motor's inertia to restart with.
const RESTARTS: [[f64; 4]; 6] = [
    [1.15, 1.5, 1.0, 1.0],
    [0.87, 0.67, 1.0, 1.0],
    [1.0, 1.0, 0.7, 1.05],
    [1.1, 1.2, 0.7, 0.95],
    [1.05, 1.0, 1.0, 1.0],
    [0.95, 1.0, 1.0, 1.0],
];

/// Gaps [rad] and factors of stiffness of the play that a soft spring may stand for.
const PLAY: [[f64; 2]; 6] =
    [[1e-3, 10.0], [1e-3, 40.0], [3e-3, 10.0], [3e-3, 40.0], [1e-2, 10.0], [1e-2, 40.0]];

/// A model whose last effect, backlash, fits better than before; `None` where it is good, or
/// where nothing better is near.
pub fn restarted(subject: &Subject, step: &FittedModel) -> Option<FittedModel> {
    let backlash = step.linear.hypothesis.effects.last().filter(|effect| effect.has_backlash())?;
    let from = |factors: &[f64; 4]| {
        let values = backlash.values.iter().zip(factors).map(|(value, factor)| value * factor);
        EffectInstance { values: values.collect(), ..backlash.clone() }
    };
    better_from(subject, step, RESTARTS.iter().map(from).collect())
}

/// A model with play in the place of the soft spring that is its last effect, if that fits better: a
/// spring is found easily, and passes for play of a few milliradians behind a stiff one.
pub fn with_play(subject: &Subject, step: &FittedModel) -> Option<FittedModel> {
    let is_soft = |effect: &&EffectInstance| effect.is_spring() && !effect.has_backlash();
    let spring = step.linear.hypothesis.effects.last().filter(is_soft)?;
    let has_gap = |definition: &&'static Definition| {
        definition.parameters.iter().any(|parameter| parameter.kind == Kind::Gap)
    };
    let definition = subject.catalogue.iter().find(has_gap)?;
    let from = |[gap_rad, factor]: &[f64; 2]| {
        // Stiffness, damping and the motor's inertia follow the gap; damping as the root.
        let mut values = vec![*gap_rad];
        values.extend(&spring.values);
        values[1] *= factor;
        values[2] *= factor.sqrt();
        EffectInstance { definition, joint: spring.joint, values }
    };
    better_from(subject, step, PLAY.iter().map(from).collect())
}

/// The spring alone of backlash: play that is narrow against the spring's deflection is none.
pub fn without_play(subject: &Subject, play: &EffectInstance) -> Option<EffectInstance> {
    let names = |parameters: &[Parameter]| parameters.iter().map(|p| p.name).collect::<Vec<_>>();
    let of_spring = names(play.definition.parameters.get(1..)?);
    let is_spring = |definition: &&'static Definition| names(definition.parameters) == of_spring;
    let definition = subject.catalogue.iter().find(is_spring)?;
    let values = play.values[1..].to_vec();
    let spring = EffectInstance { definition, joint: play.joint, values };
    play.has_backlash().then_some(spring)
}

/// A model whose last effect is the best that a search from these leads to, if it fits better.
fn better_from(
    subject: &Subject,
    step: &FittedModel,
    starts: Vec<EffectInstance>,
) -> Option<FittedModel> {
    let (effort, evidence) = (&subject.criteria.search, &step.evidence);
    if step.stats.worst() < effort.good_ratio {
        return None;
    }
    let mut hypothesis = step.linear.hypothesis.clone();
    let now = hypothesis.effects.pop()?;
    let open = open_in(evidence, subject, &hypothesis);
    let without = Linearisation::of(evidence, hypothesis, open)?;
    let here = Candidate::of(&without, evidence, now).0;
    let mut starts: Vec<Candidate> =
        starts.into_par_iter().map(|start| Candidate::of(&without, evidence, start).0).collect();
    starts.sort_by(|a, b| a.train.total_cmp(&b.train));
    starts.truncate(effort.restarts_followed);
    let best = starts
        .into_par_iter()
        .map(|start| start.refined(&without, evidence, effort.restart_steps))
        .min_by(|a, b| a.train.total_cmp(&b.train))
        .filter(|best| best.train < (1.0 - effort.least_restart_gain) * here.train)?;
    let hypothesis = without.hypothesis.with(best.effect);
    let steps = subject.criteria.selection.accepted_spring_steps;
    let better = FittedModel::fitted(evidence, subject, hypothesis, steps)?;
    (gain(step, &better) > 0.0).then_some(better)
}
