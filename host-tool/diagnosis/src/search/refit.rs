//! A candidate refitted together with everything else in the model.

use rayon::prelude::*;

use super::candidate::Candidate;
use super::policy::{gain, is_physical};
use super::restart::without_play;
use crate::fit::fitted_model::FittedModel;
use crate::fit::linearisation::Linearisation;
use crate::logs::subject::Subject;
use crate::rows::evidence::Evidence;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};

/// A candidate that is refitted with everything else.
#[derive(Clone)]
pub struct Finalist {
    /// The effect with its values after that.
    pub effect: EffectInstance,
    /// The model with it.
    pub model: FittedModel,
    /// Log-likelihood that the model gains by it.
    pub gain: f64,
}

impl Finalist {
    /// The last effect of a model over the one without it.
    fn of(before: &FittedModel, model: FittedModel) -> Option<Self> {
        let effect = model.linear.hypothesis.effects.last()?.clone();
        Some(Self { gain: gain(before, &model), effect, model })
    }

    fn is_physical(&self, subject: &Subject) -> bool {
        is_physical(&self.effect, subject, &self.model.evidence)
    }
}

/// The candidates of a batch in the model before them, refitted.
pub fn refitted(
    subject: &Subject,
    before: &FittedModel,
    now: &Linearisation,
    batch: Vec<Candidate>,
) -> Vec<Finalist> {
    let refit = |candidate: Candidate| {
        let from =
            |linear| finalist(subject, before, (&before.evidence, linear), &candidate.effect);
        let found = better(from(now), || from(&before.linear), subject)?;
        Some(converged(subject, before, found))
    };
    batch.into_par_iter().filter_map(refit).collect()
}

/// The same from a model on rows with other weights, then by what each leaves itself.
pub fn refitted_from(
    subject: &Subject,
    before: &FittedModel,
    from: (&Evidence, &Linearisation),
    batch: &[Candidate],
) -> Vec<Finalist> {
    let refit = |candidate: &Candidate| finalist(subject, before, from, &candidate.effect);
    batch.par_iter().filter_map(refit).collect()
}

/// A finalist refitted from the parameters as given, and where it does not gain enough so, the better of
/// that and the one refitted from the model before it: few steps from afar may lose on other joints
/// what an effect gains on its own.
fn better(
    first: Option<Finalist>,
    second: impl FnOnce() -> Option<Finalist>,
    subject: &Subject,
) -> Option<Finalist> {
    let gain =
        |finalist: &Option<Finalist>| finalist.as_ref().map_or(f64::NEG_INFINITY, |f| f.gain);
    if gain(&first) > subject.criteria.selection.least_log_likelihood {
        return first;
    }
    let second = second();
    if gain(&second) > gain(&first) { second } else { first }
}

/// A finalist that gains too little although its parameters gain by what is known of them, refitted with
/// slopes of its own: those of a model without it have not led its rows to the end.
fn converged(subject: &Subject, before: &FittedModel, found: Finalist) -> Finalist {
    let policy = &subject.criteria.selection;
    let least = policy.least_log_likelihood;
    let penalty = |model: &FittedModel| model.linear.prior_penalty();
    let relief = 0.5 * (penalty(before) - penalty(&found.model));
    if found.gain > least || relief < least {
        return found;
    }
    let start = found.model.linear.hypothesis.clone();
    let further = FittedModel::fitted(&before.evidence, subject, start, policy.accepted_steps);
    let is_better = |further: &Finalist| further.gain > found.gain && further.is_physical(subject);
    further.and_then(|model| Finalist::of(before, model)).filter(is_better).unwrap_or(found)
}

/// A model whose last effect is new, refitted; none where that is not physical. Backlash whose play is
/// none is the spring that is left of it.
fn finalist(
    subject: &Subject,
    before: &FittedModel,
    (evidence, now): (&Evidence, &Linearisation),
    effect: &EffectInstance,
) -> Option<Finalist> {
    let steps = subject.criteria.selection.finalist_steps;
    let of = |start: Hypothesis| {
        let model = FittedModel::fitted_near(now, evidence, subject, start, steps)?;
        Finalist::of(before, model)
    };
    let mut start = now.hypothesis.clone();
    if let Some(place) = start.spring_replaced_by(effect, subject.known_effects.len()) {
        start.effects.remove(place);
    }
    let found = of(start.with(effect.clone()))?;
    if found.is_physical(subject) {
        return Some(found);
    }
    let mut spring = found.model.linear.hypothesis.clone();
    *spring.effects.last_mut()? = without_play(subject, &found.effect)?;
    of(spring).filter(|found| found.is_physical(subject))
}
