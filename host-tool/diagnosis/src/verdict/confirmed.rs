//! What causes are worth on the logs that chose nothing.

use super::blocks::Blocks;
use crate::fit::fitted_model::FittedModel;
use crate::fit::gauss_newton::fit_held;
use crate::fit::linearisation::Linearisation;
use crate::logs::subject::Subject;
use crate::rows::evidence::Rows;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};

/// Models that are compared on the confirming logs, their parameters no further from the model as
/// given than the doubt about it allows.
pub struct Confirmation<'a> {
    subject: &'a Subject,
    /// The model refitted without any cause.
    pub refitted: Held,
    /// The model with all causes.
    pub full: Held,
    /// The model without each of its causes; the refitted one where there is but one.
    pub without: Vec<Held>,
    /// Noise of a joint's rows in every stretch, rms [V], by joint.
    noise_v: [Vec<f64>; 3],
}

/// A model within its doubt, and what it leaves.
#[derive(Clone)]
pub struct Held {
    /// The model.
    pub linear: Linearisation,
    /// What it leaves of all rows [V].
    pub residual_v: Rows,
}

/// A cause's worth on the confirming logs, with 95 % intervals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worth {
    /// Part of the gap's squares above the noise.
    pub share: f64,
    /// Its interval.
    pub share_interval: [f64; 2],
    /// 1 - rms with it / rms without it.
    pub shrinkage: f64,
    /// Its interval.
    pub shrinkage_interval: [f64; 2],
}

impl<'a> Confirmation<'a> {
    /// Of a refitted model and one with causes; `noise_v` by joint and stretch.
    pub fn of(
        subject: &'a Subject,
        refitted: &FittedModel,
        last: &FittedModel,
        noise_v: [Vec<f64>; 3],
    ) -> Self {
        let known = subject.known_effects.len();
        let held = |model: &FittedModel| Held::of(subject, model);
        let (refitted, full) = (held(refitted), held(last));
        let count = last.linear.hypothesis.effects.len() - known;
        let without = |index: usize| match count {
            1 => refitted.clone(),
            _ => without(subject, last, known + index).map_or_else(|| full.clone(), |m| held(&m)),
        };
        let without = (0..count).map(without).collect();
        Self { subject, refitted, full, without, noise_v }
    }

    /// Joints (0 to 2) on which an effect is judged: its own, or all of the rig.
    fn joints_of(&self, effect: &EffectInstance) -> Vec<usize> {
        match effect.joint {
            0 => self.subject.joints.clone(),
            joint => vec![usize::from(joint) - 1],
        }
    }

    /// The worth of the cause at this place among those added.
    pub fn worth(&self, last: &FittedModel, index: usize) -> Worth {
        let effect = &last.linear.hypothesis.effects[self.subject.known_effects.len() + index];
        self.worth_of(last, effect, &self.without[index].residual_v, &self.full.residual_v)
    }

    /// The worth of an effect by what models leave without and with it.
    pub fn worth_of(
        &self,
        last: &FittedModel,
        effect: &EffectInstance,
        without_v: &Rows,
        with_v: &Rows,
    ) -> Worth {
        let models = [without_v, with_v, &self.refitted.residual_v];
        let noise_v = |joint: usize, s: usize| self.noise_v[joint][s];
        let blocks = Blocks::of(&last.evidence, &self.joints_of(effect), &models, noise_v);
        let draws = self.subject.criteria.verdict.draws;
        let share = |sums: &[f64]| match sums {
            [without, with, gap, noise] if gap > noise => (without - with) / (gap - noise),
            _ => 0.0,
        };
        let shrinkage = |sums: &[f64]| match sums {
            [without, with, ..] if *without > 0.0 => 1.0 - (with / without).sqrt(),
            _ => 0.0,
        };
        let (share, share_interval) = blocks.figure(draws, share);
        let (shrinkage, shrinkage_interval) = blocks.figure(draws, shrinkage);
        Worth { share, share_interval, shrinkage, shrinkage_interval }
    }

    /// Part of the gap's squares above the noise that all causes take together, all joints.
    pub fn explained(&self, last: &FittedModel) -> f64 {
        let models = [&self.refitted.residual_v, &self.full.residual_v];
        let noise_v = |joint: usize, s: usize| self.noise_v[joint][s];
        let blocks = Blocks::of(&last.evidence, &self.subject.joints, &models, noise_v);
        blocks.figure(1, |sums| (sums[0] - sums[1]) / (sums[0] - sums[2]).max(1e-300)).0
    }
}

impl Held {
    /// A fitted model brought back to within the doubt about the model as given: what that can
    /// explain, and no more.
    pub fn of(subject: &Subject, model: &FittedModel) -> Self {
        let far = model.stats.prior_penalty > subject.criteria.fit.unexplained_prior_penalty;
        let held = far
            .then(|| fit_held(&model.evidence, subject, model.linear.hypothesis.clone()))
            .flatten();
        match held {
            Some(linear) => {
                Self { residual_v: model.evidence.volts(&linear.residual), linear }
            }
            None => Self { linear: model.linear.clone(), residual_v: model.residual_v.clone() },
        }
    }
}

/// A model without one of its effects, refitted.
fn without(subject: &Subject, last: &FittedModel, index: usize) -> Option<FittedModel> {
    let mut hypothesis: Hypothesis = last.linear.hypothesis.clone();
    hypothesis.effects.remove(index);
    let steps = subject.criteria.verdict.without_cause_steps;
    FittedModel::fitted_with_slopes(&last.evidence, subject, hypothesis, steps)
}
