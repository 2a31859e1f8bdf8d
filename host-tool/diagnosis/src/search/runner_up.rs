//! Effects that came second in a round to another joint's, added without a round of their own.
//!
//! On an arm of many joints most causes lie apart: once one is added, what those of other joints gain hardly changes, and
//! a round for each would seek the same again.

use super::candidate::Candidate;
use super::from_given::with_given_parameters;
use super::objection::objection;
use super::policy::gain;
use super::refit::{Finalist, refitted};
use super::winner::{Winner, finished_and_accepted};
use crate::fit::fitted_model::FittedModel;
use crate::logs::subject::Subject;
use crate::trial::hypothesis::EffectInstance;

/// An effect that would have been added, had none of another joint gained more.
#[derive(Clone)]
pub(super) struct RunnerUp {
    effect: EffectInstance,
    /// Log-likelihood that the model gained by it then.
    gain: f64,
    /// What else was tried on its joint or on several, the best first.
    pub rivals: Vec<EffectInstance>,
}

impl RunnerUp {
    /// The best of each other joint than the winner's, of the finalists (each effect once, the best first) that surely pay
    /// and gain more than any that acts on several joints; none on arms of few joints.
    pub fn of(
        subject: &Subject,
        before: &FittedModel,
        finalists: &[Finalist],
        winner: &EffectInstance,
    ) -> Vec<Self> {
        let effort = &subject.criteria.search;
        if subject.joints.len() < effort.apart_from_joints || !is_of_one_joint(winner) {
            return Vec::new();
        }
        let least = effort.runner_up_gain * subject.criteria.selection.least_log_likelihood;
        let apart = finalists.iter().take_while(|finalist| is_of_one_joint(&finalist.effect));
        let mut found: Vec<Self> = Vec::new();
        for finalist in apart.filter(|finalist| finalist.gain > least) {
            let joint = finalist.effect.joint;
            let is_taken = joint == winner.joint || found.iter().any(|f| f.effect.joint == joint);
            if !is_taken && objection(before, &finalist.model, &subject.criteria).is_none() {
                found.push(Self::among(before, finalist, finalists));
            }
        }
        found
    }

    fn among(before: &FittedModel, finalist: &Finalist, others: &[Finalist]) -> Self {
        let own = &finalist.effect;
        let may_be_it = |other: &&EffectInstance| {
            let acts_there = other.joint == own.joint || !is_of_one_joint(other);
            acts_there && !other.is_same_cause(own)
        };
        let rivals = others.iter().map(|other| &other.effect).filter(may_be_it).cloned();
        let gain = gain(before, &finalist.model);
        Self { effect: own.clone(), gain, rivals: rivals.collect() }
    }

    /// It as the winner of the next round, where it still gains a good part of what it did and is accepted.
    pub fn wins(&self, subject: &Subject, before: &FittedModel) -> Option<Winner> {
        let start = with_given_parameters(subject, before)?;
        let candidate = Candidate { effect: self.effect.clone(), train: 0.0 };
        let finalist = refitted(subject, before, &start, vec![candidate]).pop()?;
        if finalist.gain < subject.criteria.search.runner_up_keeps * self.gain {
            return None;
        }
        let model = finished_and_accepted(subject, before, &finalist)?;
        Some(Winner { effect: finalist.effect, model })
    }
}

/// Whether an effect acts on its own joint's rows alone.
fn is_of_one_joint(effect: &EffectInstance) -> bool {
    effect.joint > 0 && !effect.definition.couples_joints && !effect.is_spring()
}
