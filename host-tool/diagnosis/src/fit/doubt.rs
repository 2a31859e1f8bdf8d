//! How far the model as given is off, seen in the parameters that logs determine: one drawn up in CAD
//! is off by a tenth or two everywhere, one whose arm carries something in a few parameters.

use rayon::prelude::*;

use super::fitted_model::FittedModel;
use super::gauss_newton::open_in;
use super::unknowns::{Expected, Unknown, expected};
use crate::criteria::{Doubt, PriorCriteria};
use crate::logs::subject::Subject;

/// Median of a normal variable's absolute value, in its standard deviations.
const MEDIAN_OF_NORMAL: f64 = 0.6745;

/// A wider doubt about the model, in parts of its parameters, where the last model of a search explains
/// more once its parameters are all but free, and most of them, not some, go far then. Those that are
/// held would not tell: what they leave counts as misfit, and against misfit rows weigh little.
pub fn wider(subject: &Subject, last: &FittedModel) -> Option<Doubt> {
    let prior = &subject.criteria.prior;
    let mut doubting = subject.clone();
    doubting.doubt(Doubt::both(prior.widest));
    let start = last.linear.hypothesis.clone();
    let steps = subject.criteria.fit.refit_steps;
    let free = FittedModel::fitted(&last.evidence, &doubting, start, steps)?.settled(&doubting);
    if free.gain_over(last) > prior.least_gain { seen(subject, &free) } else { None }
}

/// The doubt that a model shows whose parameters are all but free: none where a typical one is within
/// what the subject has.
pub fn seen(subject: &Subject, free: &FittedModel) -> Option<Doubt> {
    let off = typical_deviation(subject, free)?;
    if off > subject.criteria.prior.least_typical { likeliest(subject, free) } else { None }
}

/// The doubt by which the logs are most likely: one about all parameters, or one about masses and another about
/// friction where that is more likely by more than a choice. None where it is what the subject has.
fn likeliest(subject: &Subject, free: &FittedModel) -> Option<Doubt> {
    let prior = &subject.criteria.prior;
    let (masses, friction) = (steps(prior.relative, prior), steps(prior.relative_friction, prior));
    let alike = masses.into_iter().zip(friction);
    let alike = likeliest_of(
        subject,
        free,
        alike.map(|(masses, friction)| Doubt { masses, friction }).collect(),
    )?;
    let apart = apart(subject, free, alike)?;
    let (best, _) = if apart.1 - alike.1 > prior.least_gain_apart { apart } else { alike };
    (best != prior.doubt()).then_some(best)
}

/// The likeliest doubts about masses and about friction, either sought where the other was found, from those
/// that are likeliest alike, with the logarithm of their likelihood.
fn apart(subject: &Subject, free: &FittedModel, alike: (Doubt, f64)) -> Option<(Doubt, f64)> {
    const ROUNDS: usize = 2;
    let prior = &subject.criteria.prior;
    let mut best = alike;
    for _ in 0..ROUNDS {
        let now = best.0;
        let masses = steps(prior.relative, prior).into_iter();
        let of_masses = masses.map(|masses| Doubt { masses, ..now }).collect();
        let now = likeliest_of(subject, free, of_masses)?.0;
        let friction = steps(prior.relative_friction, prior).into_iter();
        let of_friction = friction.map(|friction| Doubt { friction, ..now }).collect();
        best = likeliest_of(subject, free, of_friction)?;
    }
    Some(best)
}

/// The likeliest of some doubts, with the logarithm of its likelihood.
fn likeliest_of(subject: &Subject, free: &FittedModel, doubts: Vec<Doubt>) -> Option<(Doubt, f64)> {
    let of = |doubt: Doubt| Some((doubt, likelihood(subject, free, doubt)?));
    doubts.into_par_iter().filter_map(of).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Doubts from one that there is to the widest, on a logarithmic scale.
fn steps(least: f64, prior: &PriorCriteria) -> Vec<f64> {
    const STEPS: usize = 16;
    let part = |step: usize| (prior.widest / least).powf(step as f64 / STEPS as f64);
    (0..=STEPS).map(|step| least * part(step)).collect()
}

/// Logarithm of the likelihood of the logs, whatever the parameters are, by a doubt about them.
fn likelihood(subject: &Subject, free: &FittedModel, doubt: Doubt) -> Option<f64> {
    let mut doubting = subject.clone();
    doubting.doubt(doubt);
    let known = open_in(&free.evidence, &doubting, &free.linear.hypothesis);
    free.linear.log_marginal_likelihood(known)
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
    let relative = match expected.unknown {
        Unknown::Friction { .. } => prior.relative_friction,
        _ => prior.relative,
    };
    expected.deviation < 2.0 * relative * expected.mean.abs()
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
