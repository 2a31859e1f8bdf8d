//! How far the model as given is off, seen in the parameters that logs determine: one drawn up in CAD
//! is off by a tenth or two everywhere, one whose arm carries something in a few parameters.

use super::fitted_model::FittedModel;
use super::unknowns::Unknown;
use crate::logs::subject::Subject;

/// Median of a normal variable's absolute value, in its standard deviations.
const MEDIAN_OF_NORMAL: f64 = 0.6745;

/// A wider doubt about the model, in parts of its parameters, where no cause that was found brings
/// them back to within the doubt, and most of them, not some, are far off.
pub fn wider(subject: &Subject, last: &FittedModel) -> Option<f64> {
    let prior = &subject.criteria.prior;
    let off = typical_deviation(last, prior.told_by_logs)?;
    let is_wrong = last.stats.is_implausible(&subject.criteria.fit) && off > prior.least_typical;
    let wanted = (prior.margin * off * prior.relative).min(prior.widest);
    (is_wrong && wanted > prior.relative).then_some(wanted)
}

/// How far a typical parameter is from the model as given, in standard deviations of the prior, of
/// those that logs tell to a part of that.
fn typical_deviation(last: &FittedModel, told_by_logs: f64) -> Option<f64> {
    let linear = &last.linear;
    let is_told = |place: &usize| {
        let expected = &linear.expected[*place];
        is_of_model(expected.unknown)
            && linear.deviation(*place) < told_by_logs * expected.deviation
    };
    let deviation = |place: usize| {
        let expected = &linear.expected[place];
        ((expected.unknown.get(&linear.hypothesis) - expected.mean) / expected.deviation).abs()
    };
    let mut deviations: Vec<f64> =
        (0..linear.expected.len()).filter(is_told).map(deviation).collect();
    deviations.sort_by(f64::total_cmp);
    deviations.get(deviations.len() / 2).map(|median| median / MEDIAN_OF_NORMAL)
}

/// Masses, Coulomb and viscous friction: what a model file tells of any machine.
fn is_of_model(unknown: Unknown) -> bool {
    matches!(unknown, Unknown::Base(_) | Unknown::Friction { .. }) && !unknown.shapes_friction()
}
