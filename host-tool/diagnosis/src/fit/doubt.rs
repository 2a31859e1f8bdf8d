//! How far the model as given is off, seen in the parameters that logs determine: one drawn up in CAD
//! is off by a tenth or two everywhere, one whose arm carries something in a few parameters.

use super::fitted_model::FittedModel;
use super::gauss_newton::open_in;
use super::unknowns::{Expected, Unknown, expected};
use crate::criteria::PriorCriteria;
use crate::logs::subject::Subject;

/// Median of a normal variable's absolute value, in its standard deviations.
const MEDIAN_OF_NORMAL: f64 = 0.6745;

/// A wider doubt about the model, in parts of its parameters, where the last model of a search explains
/// more once its parameters are all but free, and most of them, not some, go far then. Those that are
/// held would not tell: what they leave counts as misfit, and against misfit rows weigh little.
pub fn wider(subject: &Subject, last: &FittedModel) -> Option<f64> {
    let prior = &subject.criteria.prior;
    let mut doubting = subject.clone();
    doubting.doubt(prior.widest);
    let start = last.linear.hypothesis.clone();
    let steps = subject.criteria.fit.refit_steps;
    let free = FittedModel::fitted(&last.evidence, &doubting, start, steps)?.settled(&doubting);
    if free.gain_over(last) > prior.least_gain { seen(subject, &free) } else { None }
}

/// The doubt that a model shows whose parameters are all but free: none where a typical one is within
/// what the subject has.
pub fn seen(subject: &Subject, free: &FittedModel) -> Option<f64> {
    let off = typical_deviation(subject, free)?;
    if off > subject.criteria.prior.least_typical { likeliest(subject, free) } else { None }
}

/// The doubt by which the logs are most likely, sought on a logarithmic scale between what the subject
/// has and the widest; none where that is what it has.
fn likeliest(subject: &Subject, free: &FittedModel) -> Option<f64> {
    const STEPS: usize = 16;
    let prior = &subject.criteria.prior;
    let doubt = |step: usize| {
        let part = step as f64 / STEPS as f64;
        prior.relative * (prior.widest / prior.relative).powf(part)
    };
    let likelihood = |step: usize| {
        let mut doubting = subject.clone();
        doubting.doubt(doubt(step));
        let known = open_in(&free.evidence, &doubting, &free.linear.hypothesis);
        Some((step, free.linear.log_marginal_likelihood(known)?))
    };
    let all = (0..=STEPS).filter_map(likelihood);
    let (best, _) = all.max_by(|a, b| a.1.total_cmp(&b.1))?;
    (best > 0).then(|| doubt(best))
}

/// How far a typical parameter of a model fitted with little prior is from the model as given, in
/// standard deviations of its prior, of those that logs tell better than that.
fn typical_deviation(subject: &Subject, free: &FittedModel) -> Option<f64> {
    let prior = &subject.criteria.prior;
    let narrow = expected(subject, free.evidence.stretches[0].sampled_s);
    let deviation = |(place, expected): (usize, &Expected)| {
        let is_told = free.linear.deviation(place) < expected.deviation;
        let value = expected.unknown.get(&free.linear.hypothesis);
        (is_of_model(expected.unknown) && is_told && is_in_proportion(expected, prior))
            .then(|| ((value - expected.mean) / expected.deviation).abs())
    };
    let mut deviations: Vec<f64> = narrow.iter().enumerate().filter_map(deviation).collect();
    deviations.sort_by(f64::total_cmp);
    deviations.get(deviations.len() / 2).map(|median| median / MEDIAN_OF_NORMAL)
}

/// Whether the doubt about a parameter is mostly one in parts of itself: one near zero, whose doubt is in parts of
/// the largest of its kind, moves little however far the model is off, and says nothing of it.
fn is_in_proportion(expected: &Expected, prior: &PriorCriteria) -> bool {
    expected.deviation < 2.0 * prior.relative * expected.mean.abs()
}

/// Masses, Coulomb and viscous friction: what a model file tells of any machine.
fn is_of_model(unknown: Unknown) -> bool {
    matches!(unknown, Unknown::Base(_) | Unknown::Friction { .. }) && !unknown.shapes_friction()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Criteria;

    #[test]
    fn a_parameter_near_zero_says_nothing_of_the_doubt() {
        let prior = Criteria::default().prior;
        let expected =
            |mean: f64, deviation: f64| Expected { unknown: Unknown::Base(0), mean, deviation };
        assert!(is_in_proportion(&expected(1.1, 0.033), &prior));
        assert!(is_in_proportion(&expected(-0.4, 0.012), &prior));
        assert!(!is_in_proportion(&expected(0.0046, 5e-4), &prior));
        assert!(!is_in_proportion(&expected(0.0, 1e-4), &prior));
    }
}
