//! Lengths of the closed form in place of an effect of the whole robot: a small force along gravity, say, is what lengths
//! do that are two per cent off.

use nalgebra::{DMatrix, DVector};

use super::fault::{LENGTHS, ModelFault, lengths_m};
use crate::criteria::FaultCriteria;
use crate::fit::fitted_model::FittedModel;
use crate::fit::linearisation::Linearisation;
use crate::logs::subject::Subject;
use crate::rows::evidence::{Evidence, RowChange, Rows};
use crate::trial::hypothesis::{EffectInstance, Hypothesis};
use crate::trial::residual_rows::train_residual_rows;
use rig::plant::Body;

/// Whether lengths within their doubt explain nearly all that an effect of the whole robot does, by a model without it.
pub fn is_by_lengths(subject: &Subject, without: &FittedModel, effect: &EffectInstance) -> bool {
    let explained = subject.criteria.faults.explained;
    let part = || part_by_lengths(subject, without, effect);
    effect.joint == 0 && part().is_some_and(|part| part >= explained)
}

/// Squares that lengths within their doubt take of what a model leaves, over those that an effect takes which it lacks,
/// everything else refitted by its slopes. `None` where the robot has no such lengths.
fn part_by_lengths(
    subject: &Subject,
    FittedModel { linear, evidence, .. }: &FittedModel,
    effect: &EffectInstance,
) -> Option<f64> {
    subject.plant.body.as_rrr().filter(|_| !subject.one_joint)?;
    let slopes: Vec<RowChange> =
        (0..LENGTHS).map(|k| length_slope(subject, evidence, linear, k)).collect();
    let doubt_m = |k: usize, _| length_doubt_m(subject, k, &subject.criteria.faults);
    let weights = DVector::from_fn(LENGTHS, doubt_m).map(|doubt_m| doubt_m.powi(-2));
    let by_lengths = squares_taken(linear, &slopes, &weights)?;
    let mut with = linear.hypothesis.clone();
    with.effects.push(effect.clone());
    let change = change(linear, &train_residual_rows(evidence, &with), 1.0);
    let by_effect = squares_taken(linear, &[change], &DVector::zeros(1))?;
    (by_effect > 0.0).then(|| by_lengths / by_effect)
}

/// How far a length may be off, the `k`-th of a fault's [m].
pub(super) fn length_doubt_m(subject: &Subject, k: usize, criteria: &FaultCriteria) -> f64 {
    criteria.length_part * lengths_m(subject)[k].abs().max(criteria.least_length_m)
}

/// Gives a hypothesis the lengths of a subject, where those of the closed form may be others.
pub(super) fn take_lengths(hypothesis: &mut Hypothesis, subject: &Subject) {
    if let (Body::Rrr(own), Some(rrr)) = (&mut hypothesis.plant.body, subject.plant.body.as_rrr()) {
        own.geometry = rrr.geometry;
    }
}

/// Change of the train rows per metre of a length.
fn length_slope(
    subject: &Subject,
    rows: &Evidence,
    without: &Linearisation,
    k: usize,
) -> RowChange {
    let step_m = SLOPE_STEP * length_doubt_m(subject, k, &subject.criteria.faults);
    let mut longer_m = [0.0; LENGTHS];
    longer_m[k] = step_m;
    let fault = ModelFault::Lengths(longer_m);
    let mut hypothesis = without.hypothesis.clone();
    take_lengths(&mut hypothesis, &fault.corrected(subject));
    // What rows keep of the rigid body is that of the lengths as given.
    let rows = rows.with_stretches(|stretch| fault.correct(stretch));
    change(without, &train_residual_rows(&rows, &hypothesis), step_m)
}

/// Change of the train rows of a model to those `moved` by a step, per unit.
pub(super) fn change(from: &Linearisation, moved: &Rows, step: f64) -> RowChange {
    let of_joint = |joint: usize| -> Option<Vec<f64>> {
        let both = moved[joint].iter().zip(&from.residual[joint]);
        (!moved[joint].is_empty()).then(|| both.map(|(to, from)| (to - from) / step).collect())
    };
    (0..moved.len()).map(of_joint).collect()
}

/// Squares that the best step along some slopes takes, `weights` of a step's squares counted against it and everything
/// open refitted.
fn squares_taken(
    from: &Linearisation,
    slopes: &[RowChange],
    weights: &DVector<f64>,
) -> Option<f64> {
    let (gradient, curvature) = from.along(&RowChange::default(), slopes);
    let curvature = curvature + DMatrix::from_diagonal(weights);
    Some(gradient.dot(&curvature.cholesky()?.solve(&gradient)))
}

/// Step for a difference along a length, in parts of its doubt.
const SLOPE_STEP: f64 = 0.01;
