//! What causes are worth on the logs that chose nothing.

use super::blocks::Blocks;
use super::held::Held;
use super::worth::Worth;
use crate::fit::fitted_model::FittedModel;
use crate::logs::subject::Subject;
use crate::rows::evidence::Rows;
use crate::search::found::Added;
use crate::trial::hypothesis::EffectInstance;

/// Models that are compared on the confirming logs, their parameters no further from the model as
/// given than the doubt about it allows.
pub struct Confirmation<'a> {
    pub(super) subject: &'a Subject,
    /// The model refitted without any cause.
    pub refitted: Held,
    /// The model with all causes.
    pub full: Held,
    /// The model without each of its causes, by rows that weigh as with it: the refitted one where there is but one
    /// and they weigh so.
    pub without: Vec<Held>,
    /// Noise of a joint's rows in every stretch, rms [V], by joint.
    pub(super) noise_v: Vec<Vec<f64>>,
}

impl<'a> Confirmation<'a> {
    /// Of a refitted model, within its doubt, and one with causes added; `noise_v` by joint and
    /// stretch.
    pub fn of(
        subject: &'a Subject,
        refitted: Held,
        last: &FittedModel,
        added: &[Added],
        noise_v: Vec<Vec<f64>>,
    ) -> Self {
        let held = |model: &FittedModel| Held::of(subject, model);
        let full = held(last);
        let without = match added {
            // By the same weights: what else the weights change is not the cause's.
            [_] if !last.evidence.systematic => vec![refitted.clone()],
            several => several.iter().map(|added| held(&added.without)).collect(),
        };
        Self { subject, refitted, full, without, noise_v }
    }

    /// Joints (from 0) on which an effect acts: its own, or all of the rig.
    pub fn joints_of(&self, effect: &EffectInstance) -> Vec<usize> {
        match effect.joint {
            0 => self.subject.joints.clone(),
            joint => vec![usize::from(joint) - 1],
        }
    }

    /// Joints on which an effect is judged: those on which it acts, or all of the rig where hardly more
    /// than noise is left there without it, or less goes there, in units of noise, than elsewhere: parameters
    /// have taken its place, and what they leave by that is on other joints.
    pub(super) fn joints_judged(
        &self,
        last: &FittedModel,
        effect: &EffectInstance,
        [without_v, with_v]: [&Rows; 2],
    ) -> Vec<usize> {
        let own = self.joints_of(effect);
        let noise_v = |joint: usize, s: usize| self.noise_v[joint][s];
        let of = |joints: &[usize], figure: fn(&[f64]) -> f64| {
            Blocks::of(&last.evidence, joints, &[without_v, with_v], noise_v).figure(1, figure).0
        };
        let over = of(&own, |sums| sums[0] / sums[2].max(1e-300));
        let goes = |joint: &usize| of(&[*joint], |sums| (sums[0] - sums[1]) / sums[2].max(1e-300));
        let (here, elsewhere): (Vec<usize>, Vec<usize>) =
            self.subject.joints.iter().partition(|joint| own.contains(joint));
        let sum = |joints: &[usize]| joints.iter().map(goes).sum::<f64>();
        let least = 1.0 + self.subject.criteria.verdict.least_excess;
        let is_elsewhere = over < least || sum(&here) < sum(&elsewhere);
        if is_elsewhere { self.subject.joints.clone() } else { own }
    }

    /// The worth of an effect by what models leave without and with it.
    pub fn worth_of(
        &self,
        last: &FittedModel,
        effect: &EffectInstance,
        without_v: &Rows,
        with_v: &Rows,
    ) -> Worth {
        let joints = self.joints_judged(last, effect, [without_v, with_v]);
        self.worth_on(last, &joints, without_v, with_v)
    }

    /// The same on some joints (from 0).
    pub(super) fn worth_on(
        &self,
        last: &FittedModel,
        joints: &[usize],
        without_v: &Rows,
        with_v: &Rows,
    ) -> Worth {
        let models = [without_v, with_v, &self.refitted.residual_v];
        let noise_v = |joint: usize, s: usize| self.noise_v[joint][s];
        let blocks = Blocks::of(&last.evidence, joints, &models, noise_v);
        Worth::of(&blocks, &self.subject.criteria.verdict)
    }

    /// The worth of an effect on some joints by which it is judged, of the same models: joints count in units of
    /// what is left on each. A cause of the whole robot may take nearly all of one joint's gap, and little beside
    /// what another joint leaves. `told` is its worth in volts, which on one joint is the same.
    pub fn weighed_worth(
        &self,
        last: &FittedModel,
        joints: &[usize],
        without_v: &Rows,
        told: Worth,
    ) -> Worth {
        let with_v = &self.full.residual_v;
        if joints.len() == 1 {
            return told;
        }
        let models = [without_v, with_v, &self.refitted.residual_v];
        let noise_v = |joint: usize, s: usize| self.noise_v[joint][s];
        let unit_v = |joint: usize| {
            let blocks = Blocks::of(&last.evidence, &[joint], &[with_v], noise_v);
            // A joint that stands still leaves less than noise, or nothing.
            blocks.figure(1, |sums| sums[0].max(sums[1]).sqrt()).0.max(1e-100)
        };
        let blocks = Blocks::in_units(&last.evidence, joints, &models, noise_v, unit_v);
        Worth::of(&blocks, &self.subject.criteria.verdict)
    }

    /// Whether a model with tables leaves little of the gap: what remains is at the noise or drawn.
    pub fn is_drawn(&self, last: &FittedModel, with_tables_v: &Rows) -> bool {
        let models = [&self.refitted.residual_v, with_tables_v];
        let noise_v = |joint: usize, s: usize| self.noise_v[joint][s];
        let blocks = Blocks::of(&last.evidence, &self.subject.joints, &models, noise_v);
        let explained = |sums: &[f64]| (sums[0] - sums[1]) / (sums[0] - sums[2]).max(1e-300);
        blocks.figure(1, explained).0 >= self.subject.criteria.verdict.explained
    }

    /// Whether an effect takes noise of the confirming logs for motion: there is no gap above the noise, or it leaves a
    /// smaller part of the noise than what the noise may be wrong by, which is the more, the further the gap is above
    /// it (`least_noise`, `least_noise_far`).
    pub fn takes_noise(&self, last: &FittedModel, effect: &EffectInstance) -> bool {
        let criteria = &self.subject.criteria.verdict;
        let noise_v = |joint: usize, s: usize| self.noise_v[joint][s];
        let models = [&self.refitted.residual_v, &self.full.residual_v];
        let blocks = Blocks::of(&last.evidence, &self.joints_of(effect), &models, noise_v);
        let over =
            |model: usize| blocks.figure(1, |sums| (sums[model] / sums[2].max(1e-300)).sqrt()).0;
        let (without, with) = (over(0), over(1));
        let is_far = without >= criteria.far_above_noise;
        let least = if is_far { criteria.least_noise_far } else { criteria.least_noise };
        without < criteria.no_gap_ratio || with < least
    }

    /// What the refitted model leaves, its parameters within their doubt, in units of noise.
    pub fn over_noise(&self, last: &FittedModel) -> f64 {
        let of_joint = |joint: &usize| {
            let noise_v = |joint: usize, s: usize| self.noise_v[joint][s];
            let models = [&self.refitted.residual_v];
            let blocks = Blocks::of(&last.evidence, &[*joint], &models, noise_v);
            blocks.figure(1, |sums| (sums[0] / sums[1].max(1e-300)).sqrt()).0
        };
        self.subject.joints.iter().map(of_joint).fold(0.0, f64::max)
    }

    /// Part of the gap's squares above the noise that all causes take together, all joints.
    pub fn explained(&self, last: &FittedModel) -> f64 {
        self.explained_on(last, &self.subject.joints)
    }

    /// The same of some joints (from 0).
    pub fn explained_on(&self, last: &FittedModel, joints: &[usize]) -> f64 {
        let models = [&self.refitted.residual_v, &self.full.residual_v];
        let noise_v = |joint: usize, s: usize| self.noise_v[joint][s];
        let blocks = Blocks::of(&last.evidence, joints, &models, noise_v);
        blocks.figure(1, |sums| (sums[0] - sums[1]) / (sums[0] - sums[2]).max(1e-300)).0
    }
}
