//! Fits that begin at the parameters as given, from where effects are searched for.

use super::winner::is_all_physical;
use crate::fit::fitted_model::FittedModel;
use crate::fit::linearisation::Linearisation;
use crate::fit::preparation::as_given;
use crate::fit::unknowns::kept_physical;
use crate::logs::subject::Subject;
use crate::trial::hypothesis::Hypothesis;

/// The effects of a refitted model in the model as given. Effects are searched for from there,
/// because the refit absorbs part of an effect that is missing; what shapes friction around
/// standstill stays as it was refitted, for there nothing hides.
pub(super) fn with_given_parameters(
    subject: &Subject,
    refitted: &FittedModel,
) -> Option<Linearisation> {
    let Linearisation { hypothesis, expected, .. } = &refitted.linear;
    let (effects, tables) = (hypothesis.effects.clone(), hypothesis.tables.clone());
    let mut start = Hypothesis { effects, tables, ..as_given(subject) };
    for expected in expected.iter().filter(|expected| expected.unknown.shapes_friction()) {
        expected.unknown.set(&mut start, expected.unknown.get(hypothesis));
    }
    kept_physical(&mut start, subject);
    Linearisation::of(&refitted.evidence, start, expected.clone())
}

/// Whether the arm is a chain, whose many parameters leave fits short of their end; the three-joint robot's reach it.
pub(super) fn is_chain(subject: &Subject) -> bool {
    subject.plant.as_chain().is_some()
}

/// A refitted model without effects that was searched for: the better of it and one fitted from the parameters as
/// given, from where candidates are.
pub(super) fn refitted_from_given(subject: &Subject, refitted: FittedModel) -> FittedModel {
    if !is_chain(subject) {
        return refitted;
    }
    let start = with_given_parameters(subject, &refitted);
    let again = start.and_then(|start| whole_from_given(subject, &refitted, &start));
    let gains = again.filter(|again| again.gain_over(&refitted) > 0.0);
    gains.map_or(refitted, |again| again.settled(subject))
}

/// The better of two fits from the parameters as given, where candidates are, by few steps and by slopes of its own; none
/// where neither is better than the model so far. What a better fit alone gains is no effect's.
pub(super) fn better_from_given(subject: &Subject, last: &FittedModel) -> Option<FittedModel> {
    let start = with_given_parameters(subject, last)?;
    let (evidence, given) = (&last.evidence, start.hypothesis.clone());
    let steps = subject.criteria.selection.finalist_steps;
    let (near, whole) = rayon::join(
        || FittedModel::fitted_near(&start, evidence, subject, given, steps),
        || whole_from_given(subject, last, &start),
    );
    [near, whole].into_iter().flatten().fold(None, |best: Option<FittedModel>, model| {
        let gains = model.gain_over(best.as_ref().unwrap_or(last)) > 0.0;
        if gains && is_all_physical(subject, &model) { Some(model.settled(subject)) } else { best }
    })
}

/// A model fitted from the parameters as given, with slopes of its own.
fn whole_from_given(
    subject: &Subject,
    fitted: &FittedModel,
    start: &Linearisation,
) -> Option<FittedModel> {
    let steps = subject.criteria.selection.accepted_steps;
    FittedModel::fitted(&fitted.evidence, subject, start.hypothesis.clone(), steps)
}
