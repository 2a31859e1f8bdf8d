//! What varies with velocity.

use super::fit::{Design, Fit};
use super::found::Found;
use super::nodes::Nodes;
use super::samples::Samples;
use super::shape::{centred, explained};
use crate::result::Axis;

/// Nodes over speed: where it is low, friction bends most.
const LEVELS: [f64; 9] = [0.0, 0.05, 0.12, 0.25, 0.4, 0.6, 0.8, 0.95, 1.0];

/// An even and an odd function of velocity.
pub(super) fn find(samples: &Samples) -> Option<Found> {
    let speed: Vec<f64> = samples.velocity_rad_per_s.iter().map(|v| v.abs()).collect();
    let nodes = Nodes::at_levels(speed.iter().copied(), &LEVELS);
    let n = nodes.len();
    let design = Design::of(samples.len(), 1 + 2 * n, |k, row| {
        row.push((0, 1.0));
        for (node, weight) in nodes.weights(speed[k]) {
            row.extend([(1 + node, weight), (1 + n + node, weight * samples.direction[k])]);
        }
    });
    let fit = Fit::of(&design, &samples.residual_v, &samples.fold);
    let even: Vec<usize> = (0..=n).collect();
    let odd: Vec<usize> = std::iter::once(0).chain(1 + n..1 + 2 * n).collect();
    let both: Vec<usize> = (0..1 + 2 * n).collect();
    // What is even vanishes at rest, or a constant beside it is not velocity's.
    let of = |columns: &[usize]| {
        let moving: Vec<usize> = columns.iter().copied().filter(|&c| c > 1).collect();
        fit.gain(&[0], columns).max(fit.gain(&[], &moving))
    };
    let (even_v2, odd_v2) = (of(&even), fit.gain(&[0], &odd));
    let mixed = even_v2.min(odd_v2) > samples.criteria.both_parities_part * even_v2.max(odd_v2);
    let columns = match (mixed, even_v2 > odd_v2) {
        (true, _) => &both,
        (false, true) => &even,
        (false, false) => &odd,
    };
    let moving: Vec<usize> = columns.iter().copied().filter(|&c| c > 1).collect();
    let alone = columns != &odd && fit.gain(&[], &moving) > fit.gain(&[0], columns);
    let fitted_v = if alone {
        design.times(&fit.coefficients(&moving))
    } else {
        centred(&design.times(&fit.coefficients(columns)))
    };
    let energy_v2 = if columns == &odd { odd_v2 } else { of(columns) };
    let detail = if even_v2 > odd_v2 {
        even_words(&centred(&design.times(&fit.coefficients(&even))), samples, &speed)
    } else {
        odd_words(&design.times(&fit.coefficients(&odd)), samples, &speed)
    };
    Some(Found { axis: Axis::Velocity, energy_v2, detail, fitted_v })
}

fn even_words(fitted_v: &[f64], samples: &Samples, speed: &[f64]) -> String {
    let centred_speed = centred(speed);
    let (share, slope) = explained(fitted_v, |k| centred_speed[k]);
    let (more, less) =
        if slope > 0.0 { ("forwards", "backwards") } else { ("backwards", "forwards") };
    let growth = if share > samples.criteria.clear_part { ", grows with |velocity|" } else { "" };
    format!("even in velocity: larger {more} than {less}{growth}")
}

fn odd_words(fitted_v: &[f64], samples: &Samples, speed: &[f64]) -> String {
    let direction = &samples.direction;
    let linear = explained(fitted_v, |k| speed[k] * direction[k]);
    let level = explained(fitted_v, |k| direction[k]);
    let slow = explained(fitted_v, |k| direction[k] / (1e-3 + speed[k]).sqrt());
    let best = linear.0.max(level.0).max(slow.0);
    let sense = |size: f64| if size > 0.0 { "against the motion" } else { "with the motion" };
    if best < samples.criteria.clear_part {
        "odd in velocity".into()
    } else if linear.0 == best {
        format!("odd in velocity, {}: grows with |velocity|", sense(linear.1))
    } else if level.0 == best {
        format!("odd in velocity, {}: the same at every speed", sense(level.1))
    } else {
        format!("odd in velocity, {}: largest at low speed", sense(slow.1))
    }
}
