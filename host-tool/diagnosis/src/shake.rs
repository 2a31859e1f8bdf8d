//! A better fit of play than the one that a search ended at.
//!
//! A link that bounces leaves many shallow minima: a wider gap with a stiffer spring does
//! nearly the same. From near each of them the search begins anew.

use rayon::prelude::*;

use super::candidate::Candidate;
use super::evidence::Evidence;
use super::fit::{fit, open_in};
use super::linearisation::{Linearisation, Which};
use super::selection::{SPRING_STEPS, Step};
use super::subject::Subject;
use super::voltage::Added;

/// Factors of gap, stiffness, damping and the motor's inertia to begin anew with.
const SHAKES: [[f64; 4]; 4] =
    [[1.15, 1.5, 1.0, 1.0], [0.87, 0.67, 1.0, 1.0], [1.0, 1.0, 0.7, 1.05], [1.1, 1.2, 0.7, 0.95]];
/// Part of the squares that a new beginning must gain to be worth it.
const WORTH_IT: f64 = 0.05;
/// What is left when nothing need be shaken, over noise.
const GOOD_RATIO: f64 = 3.0;
const STEPS: usize = 8;

/// A model whose last effect, play, fits better than before; `None` where it is good, or
/// where nothing better is near.
pub fn shaken(evidence: &Evidence, subject: &Subject, step: &Step) -> Option<Step> {
    let play = step.linear.point.effects.last().filter(|effect| effect.has_play())?;
    if step.rest.worst() < GOOD_RATIO {
        return None;
    }
    let mut point = step.linear.point.clone();
    point.effects.pop();
    let open = open_in(evidence, subject, &point.effects);
    let without = Linearisation::of(evidence, point, open)?;
    let here = Candidate::of(&without, evidence, play.clone(), Which::TRAIN).0;
    let from = |factors: &[f64; 4]| {
        let values = play.values.iter().zip(factors).map(|(value, factor)| value * factor);
        let start = Added { values: values.collect(), ..play.clone() };
        let begun = Candidate::of(&without, evidence, start, Which::TRAIN).0;
        begun.refined(&without, evidence, STEPS, Which::TRAIN)
    };
    let best = SHAKES
        .par_iter()
        .map(from)
        .min_by(|a, b| a.score.train.total_cmp(&b.score.train))
        .filter(|best| best.score.train < (1.0 - WORTH_IT) * here.score.train)?;
    let point = without.point.with(best.effect);
    let better = Step::of(evidence, fit(evidence, subject, point, SPRING_STEPS)?);
    (better.linear.objective < step.linear.objective).then_some(better)
}
