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

/// A wider doubt about the model, and what asks for it.
pub struct Wider {
    /// The doubt by which the logs are likeliest.
    pub doubt: Doubt,
    /// Whether the model explains more once its parameters are all but free; if not, the logs are only likelier by this
    /// doubt.
    pub explains_more: bool,
}

/// A wider doubt about the model, in parts of its parameters. There is one where most parameters, not some, go far once
/// all are nearly free, and where that explains more than the causes found or makes the logs far likelier. Held parameters
/// would not tell: what they leave counts as misfit, and against misfit rows weigh little.
pub fn wider(subject: &Subject, last: &FittedModel) -> Option<Wider> {
    let mut doubting = subject.clone();
    doubting.doubt(subject.criteria.prior.widest_doubt());
    let start = last.linear.hypothesis.clone();
    let steps = subject.criteria.fit.refit_steps;
    let free = FittedModel::fitted(&last.evidence, &doubting, start, steps)?.settled(&doubting);
    let doubt = seen(subject, &free)?;
    let gain = free.gain_over(last);
    let explains_more = gain > subject.criteria.prior.least_gain;
    let is_asked_for = explains_more || is_far_likelier(subject, &free, gain, doubt);
    is_asked_for.then_some(Wider { doubt, explains_more })
}

/// Whether the logs are far likelier by a doubt than by the one that there is, told by several parameters of a free model
/// that explains hardly less than the causes found: by a `gain` of so much, which may be negative.
fn is_far_likelier(subject: &Subject, free: &FittedModel, gain: f64, doubt: Doubt) -> bool {
    let (prior, policy) = (&subject.criteria.prior, &subject.criteria.selection);
    let by = |doubt: Doubt| likelihood(subject, free, doubt);
    let likelier = by(doubt).zip(by(prior.doubt())).map(|(wider, given)| wider - given);
    gain > -policy.least_log_likelihood
        && deviations(subject, free, is_of_model).len() >= prior.fewest_told
        && likelier.is_some_and(|likelier| likelier > prior.least_doubt_likelihood)
}

/// The doubt that a model shows whose parameters are all but free: none where a typical one is within
/// what the subject has.
pub fn seen(subject: &Subject, free: &FittedModel) -> Option<Doubt> {
    let off = typical_deviation(subject, free)?;
    if off > subject.criteria.prior.least_typical { likeliest(subject, free) } else { None }
}

/// The doubt by which the logs are most likely: both kinds widened by the same step, or each by its own where that is
/// more likely by more than a choice. None where it is what the subject has.
fn likeliest(subject: &Subject, free: &FittedModel) -> Option<Doubt> {
    let prior = &subject.criteria.prior;
    let (given, widest) = (prior.doubt(), prior.widest_doubt());
    let masses = steps(given.masses, widest.masses).into_iter();
    let both = masses.zip(steps(given.friction, widest.friction));
    let of_both = both.map(|(masses, friction)| Doubt { masses, friction }).collect();
    let alike = likeliest_of(subject, free, of_both)?;
    let apart = apart(subject, free, alike)?;
    let (best, _) = if apart.1 - alike.1 > prior.least_gain_apart { apart } else { alike };
    let best = no_wider_than_told(subject, free, best);
    without_needless(subject, free, best).filter(|best| *best != given)
}

/// A doubt about masses no wider than those show that the logs tell, where they tell several: the others follow friction of
/// another law as far as a doubt lets them, a load with them.
fn no_wider_than_told(subject: &Subject, free: &FittedModel, doubt: Doubt) -> Doubt {
    let prior = &subject.criteria.prior;
    let told = deviations(subject, free, |unknown| matches!(unknown, Unknown::Base(_)));
    match typical(&told).filter(|_| told.len() >= prior.fewest_told) {
        Some(off) => {
            let shown = (prior.told_deviations * off * prior.relative).max(prior.relative);
            if doubt.masses > shown { with_masses(subject, free, shown) } else { doubt }
        }
        None => doubt,
    }
}

/// The likeliest doubt with this one about masses: friction takes what they do not.
fn with_masses(subject: &Subject, free: &FittedModel, masses: f64) -> Doubt {
    let prior = &subject.criteria.prior;
    let of_friction = steps(prior.relative_friction, prior.widest_doubt().friction);
    let all = of_friction.into_iter().map(|friction| Doubt { masses, friction }).collect();
    likeliest_of(subject, free, all)
        .map_or(Doubt { masses, friction: prior.relative_friction }, |(best, _)| best)
}

/// The likeliest doubts about masses and about friction, either sought where the other was found, from those
/// that are likeliest alike, with the logarithm of their likelihood.
fn apart(subject: &Subject, free: &FittedModel, alike: (Doubt, f64)) -> Option<(Doubt, f64)> {
    const ROUNDS: usize = 2;
    let prior = &subject.criteria.prior;
    let (given, widest) = (prior.doubt(), prior.widest_doubt());
    let (of_masses, of_friction) =
        (steps(given.masses, widest.masses), steps(given.friction, widest.friction));
    let mut best = alike;
    for _ in 0..ROUNDS {
        let of = |&masses: &f64| Doubt { masses, ..best.0 };
        best = likeliest_of(subject, free, of_masses.iter().map(of).collect())?;
        let of = |&friction: &f64| Doubt { friction, ..best.0 };
        best = likeliest_of(subject, free, of_friction.iter().map(of).collect())?;
    }
    Some(best)
}

/// A doubt that is as given of a kind of which logs tell nothing: all masses may be told by the file.
fn without_needless(subject: &Subject, free: &FittedModel, doubt: Doubt) -> Option<Doubt> {
    let given = subject.criteria.prior.doubt();
    let narrower = |narrower: Doubt, doubt: Doubt| {
        likeliest_of(subject, free, vec![narrower, doubt]).map(|(doubt, _)| doubt)
    };
    let doubt = narrower(Doubt { masses: given.masses, ..doubt }, doubt)?;
    narrower(Doubt { friction: given.friction, ..doubt }, doubt)
}

/// The likeliest of some doubts, with the logarithm of its likelihood; the first where they are as likely, since what
/// logs do not tell is no further off for that.
fn likeliest_of(subject: &Subject, free: &FittedModel, doubts: Vec<Doubt>) -> Option<(Doubt, f64)> {
    let of = |doubt: Doubt| {
        let likelihood = likelihood(subject, free, doubt)?;
        likelihood.is_finite().then_some((doubt, likelihood))
    };
    let all: Vec<(Doubt, f64)> = doubts.into_par_iter().filter_map(of).collect();
    all.into_iter().reduce(likelier)
}

/// The second of two doubts where it is likelier by more than rounding.
fn likelier(first: (Doubt, f64), second: (Doubt, f64)) -> (Doubt, f64) {
    const ROUNDING: f64 = 1e-3;
    if second.1 > first.1 + ROUNDING { second } else { first }
}

/// Doubts from the one given to the widest, on a logarithmic scale.
fn steps(given: f64, widest: f64) -> Vec<f64> {
    const STEPS: usize = 16;
    let part = |step: usize| (widest / given).powf(step as f64 / STEPS as f64);
    (0..=STEPS).map(|step| given * part(step)).collect()
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
    typical(&deviations(subject, free, is_of_model))
}

/// The standard deviation of normal variables of these absolute values, by their median.
fn typical(sorted: &[f64]) -> Option<f64> {
    sorted.get(sorted.len() / 2).map(|median| median / MEDIAN_OF_NORMAL)
}

/// How far each of some parameters is so, the nearest first.
fn deviations(
    subject: &Subject,
    free: &FittedModel,
    is_wanted: impl Fn(Unknown) -> bool,
) -> Vec<f64> {
    let prior = &subject.criteria.prior;
    let narrow = expected(subject, free.evidence.stretches[0].sampled_s);
    let deviation = |(place, expected): (usize, &Expected)| {
        let is_told = free.linear.deviation(place) < expected.deviation;
        let value = expected.unknown.get(&free.linear.hypothesis);
        (is_wanted(expected.unknown) && is_told && is_in_proportion(expected, prior))
            .then(|| ((value - expected.mean) / expected.deviation).abs())
    };
    let mut deviations: Vec<f64> = narrow.iter().enumerate().filter_map(deviation).collect();
    deviations.sort_by(f64::total_cmp);
    deviations
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
    fn of_doubts_that_are_as_likely_the_narrowest_is_taken() {
        let doubts = [0.025, 0.05, 0.1].map(Doubt::both);
        let taken = |likelihoods: [f64; 3]| {
            doubts.into_iter().zip(likelihoods).reduce(likelier).unwrap().0.masses
        };
        assert_eq!(taken([-7.0, -7.0 + 1e-9, -7.0 + 2e-9]), 0.025);
        assert_eq!(taken([-7.0, -2.0, -3.0]), 0.05);
    }

    #[test]
    fn doubts_go_from_the_one_there_is_to_the_widest() {
        let prior = Criteria::default().prior;
        let all = steps(prior.relative, prior.widest);
        assert_eq!(all[0], prior.relative);
        assert!((all[all.len() - 1] - prior.widest).abs() < 1e-12);
        assert!(all.windows(2).all(|pair| pair[1] > pair[0]));
    }

    #[test]
    fn what_is_typical_is_the_deviation_of_normal_variables_with_this_median() {
        // Masses that logs tell of an arm with a load and friction of another law.
        let told = [0.27, 0.69, 2.09, 2.66, 3.07, 3.49];
        assert!((typical(&told).unwrap() - 3.94).abs() < 0.01);
        assert_eq!(typical(&[]), None);
    }

    #[test]
    fn a_parameter_near_zero_says_nothing_of_the_doubt() {
        let prior = Criteria::default().prior;
        let expected = |mean: f64, deviation: f64| Expected::new(Unknown::Base(0), mean, deviation);
        assert!(is_in_proportion(&expected(1.1, 0.033), &prior));
        assert!(is_in_proportion(&expected(-0.4, 0.012), &prior));
        assert!(!is_in_proportion(&expected(0.0046, 5e-4), &prior));
        assert!(!is_in_proportion(&expected(0.0, 1e-4), &prior));
    }
}
