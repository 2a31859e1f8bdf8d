//! The fault that explains a gap best, if one does.

use std::cell::OnceCell;

use super::fault::ModelFault;
use super::trials::{Trial, first_part, left};
use crate::criteria::{Criteria, FaultCriteria};
use crate::fit::command_left::leaves_much;
use crate::fit::fitted_model::FittedModel;
use crate::fit::gauss_newton::fit;
use crate::logs::subject::Subject;
use crate::rows::evidence::Evidence;

/// A fault that explains the gap.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundFault {
    /// What is wrong.
    pub fault: ModelFault,
    /// Part of the squares above the noise that goes when it is put right.
    pub explained: f64,
}

/// The faults of a model as given, tried once they are asked for.
pub struct Faults<'a> {
    subject: &'a Subject,
    evidence: &'a Evidence,
    /// The best of them.
    best: OnceCell<Option<Best>>,
}

/// The best fault on a part of the train logs.
struct Best {
    part: Evidence,
    fault: ModelFault,
    /// Squares above the noise that the refitted model leaves, or one refitted from the model as given, if that is less.
    whole: f64,
    /// Those that are left once the fault is put right.
    left: f64,
}

impl<'a> Faults<'a> {
    /// Those of a subject's model, by its logs' rows; none is tried yet.
    pub fn of(subject: &'a Subject, evidence: &'a Evidence) -> Self {
        Self { subject, evidence, best: OnceCell::new() }
    }

    /// Whether one is said whatever causes a search goes on to find after those of the model so far, `last`: it leaves
    /// hardly anything, and as many causes as may be said in its place leave more than noise.
    pub fn is_sure(&self, refitted: &FittedModel, last: &FittedModel) -> bool {
        let Criteria { faults, fit, .. } = &self.subject.criteria;
        let goes_on = last.causes(self.subject) >= faults.few_causes && !last.stats.is_clean(fit);
        goes_on && self.best(refitted).is_some_and(|best| best.is_sure(faults))
    }

    /// The fault that explains nearly all that the refitted model leaves, and no less than the model with all causes,
    /// `last`, does; none where the model as given is not far off, or where a few causes leave noise alone.
    pub fn found(&self, refitted: &FittedModel, last: &FittedModel) -> Option<FoundFault> {
        let criteria = &self.subject.criteria.faults;
        let is_clean = last.stats.is_clean(&self.subject.criteria.fit);
        if is_clean && last.causes(self.subject) <= criteria.few_causes && !is_pushed(last) {
            return None;
        }
        let best = self.best(refitted)?;
        let by_causes = left_by(last, &best.part, self.subject)?;
        let as_good = best.left <= criteria.as_good * by_causes || best.is_sure(criteria);
        let explained = 1.0 - best.left / best.whole.max(1e-300);
        (best.whole > 0.0 && explained > criteria.explained && as_good)
            .then(|| FoundFault { fault: best.fault.clone(), explained })
    }

    /// Whether a model with causes leaves hardly anything of what the refitted one does, as a fault that is sure must.
    pub fn leaves_hardly_any(&self, refitted: &FittedModel, last: &FittedModel) -> bool {
        let Some(best) = self.best(refitted) else { return false };
        let by_causes = left_by(last, &best.part, self.subject);
        let is_sure = |left| is_hardly_any(left, best.whole, &self.subject.criteria.faults);
        by_causes.is_some_and(is_sure)
    }

    fn best(&self, refitted: &FittedModel) -> Option<&Best> {
        self.best.get_or_init(|| Best::of(self.subject, self.evidence, refitted)).as_ref()
    }
}

impl Best {
    /// None where the refitted model is not far off.
    fn of(subject: &Subject, evidence: &Evidence, refitted: &FittedModel) -> Option<Self> {
        let criteria = &subject.criteria.faults;
        let implausible = refitted.stats.is_implausible(&subject.criteria.fit);
        if refitted.stats.worst() < criteria.least_ratio && !implausible {
            return None;
        }
        let part = first_part(evidence, criteria.part_s);
        let mut whole = left_by(refitted, &part, subject)?;
        let bare = |fault: ModelFault| Trial::of(&part, subject, fault);
        let mut tried: Vec<Trial> = Vec::new();
        if implausible || leaves_much(subject, refitted) {
            tried.extend(ModelFault::without_size(subject).into_iter().filter_map(bare));
        }
        let sized = ModelFault::with_size(subject);
        for start in sized.into_iter().filter_map(bare) {
            // From the model as given a fit may come nearer without any fault.
            whole = whole.min(left(&part, subject, &start.linear));
            tried.push(start.with_size_found());
        }
        let best =
            tried.into_iter().min_by(|a, b| a.linear.objective.total_cmp(&b.linear.objective))?;
        let (by_fault, fault) = (left(&part, subject, &best.linear), best.fault.clone());
        drop(best);
        Some(Self { part, fault, whole, left: by_fault })
    }

    /// Whether it leaves hardly anything of the gap.
    fn is_sure(&self, criteria: &FaultCriteria) -> bool {
        is_hardly_any(self.left, self.whole, criteria)
    }
}

/// Whether squares are hardly any part of others. Of none they are none: a gap on one joint, or one that comes later,
/// may not show among all rows of the first seconds.
fn is_hardly_any(left: f64, whole: f64, criteria: &FaultCriteria) -> bool {
    whole > 0.0 && left <= criteria.sure * whole
}

/// Squares above the noise that a model leaves of a part of the logs, refitted to it.
fn left_by(model: &FittedModel, part: &Evidence, subject: &Subject) -> Option<f64> {
    let start = model.linear.hypothesis.clone();
    Some(left(part, subject, &fit(part, subject, start, subject.criteria.faults.steps)?))
}

/// Whether a force at the tip is among the causes: a small one along gravity is what lengths do that are
/// a few per cent off.
fn is_pushed(model: &FittedModel) -> bool {
    let effects = &model.linear.hypothesis.effects;
    effects.iter().any(|effect| effect.definition.name == "tip_force")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_left_of_no_gap_is_no_fault() {
        let is_sure = |left: f64, whole: f64| is_hardly_any(left, whole, &FaultCriteria::default());
        assert!(is_sure(0.0, 50.0) && is_sure(0.5, 50.0));
        assert!(!is_sure(0.6, 50.0) && !is_sure(0.0, 0.0));
    }
}
