//! A model that is fitted to the logs, and what it leaves of them.

use std::sync::OnceLock;

use super::command_gain::command_gain;
use super::gauss_newton::{fit, fit_with_slopes, open_in};
use super::linearisation::Linearisation;
use super::residual_stats::ResidualStats;
use crate::logs::subject::Subject;
use crate::rows::evidence::{Evidence, Rows};
use crate::rows::misfit::Misfit;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};
use crate::trial::residual_rows::residual_rows;

/// A model and what it leaves.
#[derive(Clone)]
pub struct FittedModel {
    /// The model.
    pub linear: Linearisation,
    /// The rows that it was fitted to, with their weights.
    pub evidence: Evidence,
    /// What it leaves of train rows [V].
    pub residual_v: Rows,
    /// The same of each row with everything refitted without it [V].
    pub left_out_v: Rows,
    /// What it leaves, against the noise.
    pub stats: ResidualStats,
    /// How much of the commands of each train stretch reaches each motor, as rows see it.
    command_gain: Vec<Vec<f64>>,
    /// Size and correlation of what it leaves, once asked for.
    misfit: OnceLock<Misfit>,
}

impl FittedModel {
    /// A fitted model with what it leaves.
    pub fn of(evidence: Evidence, linear: Linearisation) -> Self {
        let residual_v = evidence.volts(&linear.residual);
        let left_out_v = evidence.volts(&linear.left_out(&evidence));
        let stats = ResidualStats::of(&evidence, &linear, &residual_v);
        let command_gain = command_gain(&evidence, &linear.hypothesis);
        let misfit = OnceLock::new();
        Self { linear, evidence, residual_v, left_out_v, stats, command_gain, misfit }
    }

    /// A model fitted to rows, then to rows that are weighted by what it leaves of them itself:
    /// only so do rows weigh against the prior what they should.
    pub fn fitted(
        evidence: &Evidence,
        subject: &Subject,
        start: Hypothesis,
        most_steps: usize,
    ) -> Option<Self> {
        let first = fit(evidence, subject, start, most_steps)?;
        Self::reweighted(evidence, subject, first)
    }

    /// The same in haste, for a model that differs in a few effects or tables from one that is
    /// fitted already to rows with these weights: with the slopes of that one.
    pub fn fitted_near(
        near: &Linearisation,
        evidence: &Evidence,
        subject: &Subject,
        start: Hypothesis,
        most_steps: usize,
    ) -> Option<Self> {
        let open = open_in(evidence, subject, &start);
        let start = near.near(evidence, start, open)?;
        let first = fit_with_slopes(evidence, subject, start, most_steps);
        Self::reweighted(evidence, subject, first.without_parts())
    }

    /// A model fitted further to rows that are weighted by what it leaves of them itself, where it
    /// gains by that. A fit that is not yet at its end leaves rows that hang together; by what it
    /// leaves they weigh little, and the prior would draw it back from where the logs have led it.
    fn reweighted(evidence: &Evidence, subject: &Subject, first: Linearisation) -> Option<Self> {
        let before = Self::of(evidence.clone(), first);
        let own = before.misfit().weigh(evidence);
        let again = before.linear.reweighted(evidence, &own)?;
        let steps = subject.criteria.fit.reweighted_steps;
        let after = Self::of(own.clone(), fit_with_slopes(&own, subject, again, steps));
        Some(if after.gain_over(&before) < 0.0 { before } else { after })
    }

    /// The same without what only a search for one more effect needs.
    pub fn without_parts(self) -> Self {
        Self { linear: self.linear.without_parts(), ..self }
    }

    /// The same model on rows that are weighted by what it leaves of them itself, whatever they were weighted
    /// by; `None` where the numbers do not work out.
    pub fn on_own_rows(self) -> Option<Self> {
        let own = self.misfit().weigh(&self.evidence);
        let linear = self.linear.reweighted(&self.evidence, &own)?;
        Some(Self::of(own, linear))
    }

    /// The same model on rows that all count, where what it leaves was taken to be systematic.
    pub fn by_all_rows(&self) -> Self {
        if !self.evidence.systematic {
            return self.clone();
        }
        let all = self.clone().taken_as_systematic(false);
        all.clone().on_own_rows().unwrap_or(all)
    }

    /// The same where what it leaves is taken to be systematic, or not.
    pub fn taken_as_systematic(mut self, systematic: bool) -> Self {
        self.evidence.systematic = systematic;
        Self { misfit: OnceLock::new(), ..self }
    }

    /// The same with weights and fit in agreement: a model with an effect more, whose rows are
    /// weighted anew, must not gain by that alone.
    pub fn settled(self, subject: &Subject) -> Self {
        let mut settled = self;
        for _ in 0..subject.criteria.fit.most_reweightings {
            let (evidence, start) = (&settled.evidence, settled.linear.hypothesis.clone());
            let steps = subject.criteria.fit.settling_steps;
            let Some(again) = Self::fitted(evidence, subject, start, steps) else { break };
            let gain = again.gain_over(&settled);
            if gain > 0.0 {
                settled = again;
            }
            if gain < subject.criteria.fit.settled_log_likelihood {
                break;
            }
        }
        settled
    }

    /// Log-likelihood that a model gains over another. Rows count as independent as in what that one
    /// of them leaves that lasts less: what is left of a missing effect is no noise that lasts.
    pub fn gain_over(&self, other: &Self) -> f64 {
        let misfit = self.misfit().clone().at_least_as_independent(other.misfit());
        self.log_likelihood(&misfit) - other.log_likelihood(&misfit)
    }

    /// The same by one joint's rows (from 0), and by what is known of all parameters but other joints' friction and lags:
    /// an effect that acts on that joint alone does not gain by where the fits of others have come to rest.
    pub fn gain_on(&self, other: &Self, joint: usize) -> f64 {
        let misfit = self.misfit().clone().at_least_as_independent(other.misfit());
        let on_joint = |model: &Self| {
            let Self { evidence, left_out_v, command_gain, linear, .. } = model;
            misfit.log_likelihood_of(joint, evidence, left_out_v, command_gain)
                - 0.5 * linear.prior_penalty_on(joint)
        };
        on_joint(self) - on_joint(other)
    }

    /// The one of two models that is likelier, the first where they are alike.
    pub fn better_of(self, other: Self) -> Self {
        if other.gain_over(&self) > 0.0 { other } else { self }
    }

    /// What it leaves of all rows, those held out too [V].
    pub fn all_residual_v(&self) -> Rows {
        self.evidence.volts(&residual_rows(&self.evidence, &self.linear.hypothesis))
    }

    /// The size and the correlation of what it leaves.
    pub fn misfit(&self) -> &Misfit {
        self.misfit.get_or_init(|| Misfit::of(&self.evidence, &self.residual_v))
    }

    /// Log-likelihood of train rows that were left out, and of the parameters by what is known of
    /// them; rows are as independent as in `misfit`.
    ///
    /// What is left counts in volts of the command as it was sent: an effect that takes away a
    /// part of every command takes that part of what is left too, and explains nothing by that.
    pub fn log_likelihood(&self, misfit: &Misfit) -> f64 {
        misfit.log_likelihood(&self.evidence, &self.left_out_v, &self.command_gain)
            - 0.5 * self.linear.prior_penalty()
    }

    /// How many causes it has: effects that the subject's model as given does not hold already.
    pub fn causes(&self, subject: &Subject) -> usize {
        self.linear.hypothesis.effects.len() - subject.known_effects.len()
    }

    /// Whether the last of its effects is a spring between motor and link.
    pub fn ends_with_spring(&self) -> bool {
        self.linear.hypothesis.effects.last().is_some_and(EffectInstance::is_spring)
    }
}
