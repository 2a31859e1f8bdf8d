//! Shares of causes that are told, by the measure of a report: those of a search that errs nowhere.

use super::confirmed::Confirmation;
use super::held::Held;
use crate::fit::command_instants::prepared_by_instants;
use crate::fit::fitted_model::FittedModel;
use crate::fit::preparation::{self, prepared};
use crate::fit::warmth::{ask_for_warmth, gains_by_warmth};
use crate::logs::subject::Subject;
use crate::logs::usable::Usable;
use crate::rows::evidence::Evidence;
use recordings::{StepError, Trace};

/// The share of the gap that each effect has which the subject's model holds.
///
/// The model with all of them, the model without each and the model without any are refitted and
/// compared on the confirming logs as a diagnosis compares what it finds. `None` where a refit
/// fails.
///
/// # Errors
/// Logs that cannot be used.
pub fn shares(told: &Subject, traces: &[Trace]) -> Result<Vec<Option<f64>>, StepError> {
    let Usable { stretches, .. } = Usable::of(traces, told)?;
    let (_, refitted_as_told) = prepared(told, stretches.clone(), None)?;
    let warms = ask_for_warmth(told, &refitted_as_told) || gains_by_warmth(told, &refitted_as_told);
    let told = &Subject { warms, ..told.clone() };
    let (evidence, full, _) = prepared_by_instants(told, stretches, None)?;
    let Some(none) = refitted(&with_effects(told, |_| false), &evidence, &full) else {
        return Ok(vec![None; told.known_effects.len()]);
    };
    let noise_v = preparation::noise_left_v(told, &evidence, &full);
    let confirmation = Confirmation::of(told, none, &full, &[], noise_v);
    let share_of = |index: usize| {
        let without = refitted(&with_effects(told, |other| other != index), &evidence, &full)?;
        let effect = &full.linear.hypothesis.effects[index];
        let with_v = &confirmation.full.residual_v;
        Some(confirmation.worth_of(&full, effect, &without.residual_v, with_v).share)
    };
    Ok((0..told.known_effects.len()).map(share_of).collect())
}

/// A subject whose model holds some of its effects.
fn with_effects(subject: &Subject, is_kept: impl Fn(usize) -> bool) -> Subject {
    let effects = subject.known_effects.iter().cloned().enumerate();
    let known_effects: Vec<_> =
        effects.filter(|(k, _)| is_kept(*k)).map(|(_, effect)| effect).collect();
    Subject { given_effects: known_effects.len(), known_effects, ..subject.clone() }
}

/// The subject's model refitted, from where a model with more effects ended and from what the file
/// gives; the better of both.
fn refitted(subject: &Subject, evidence: &Evidence, full: &FittedModel) -> Option<Held> {
    let given = preparation::as_given(subject);
    let mut near = full.linear.hypothesis.clone();
    near.effects.clone_from(&given.effects);
    let steps = subject.criteria.fit.refit_steps;
    let fitted = [near, given].into_iter().filter_map(|start| {
        Some(FittedModel::fitted(evidence, subject, start, steps)?.settled(subject))
    });
    let better = |a: FittedModel, b: FittedModel| if b.gain_over(&a) > 0.0 { b } else { a };
    fitted.reduce(better).map(|model| Held::of(subject, &model))
}
