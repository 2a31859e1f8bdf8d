//! What changes slowly since the log began.

use super::fit::{Design, Fit};
use super::found::Found;
use super::samples::Samples;
use super::samples::root_mean_square;
use crate::quantity::volts;
use crate::result::Axis;

/// Degrees of the polynomials in time.
const DEGREES: usize = 3;
/// What a trend may multiply: nothing, the direction, the velocity.
const CARRIERS: usize = 3;

/// A trend of the level, of dry friction or of viscous friction, the same in every log.
pub(super) fn find(samples: &Samples) -> Option<Found> {
    let end_s = samples.time_s.iter().copied().fold(0.0, f64::max);
    if end_s <= 0.0 {
        return None;
    }
    let rms = root_mean_square(&samples.velocity_rad_per_s).max(f64::MIN_POSITIVE);
    let carriers = |k: usize| [1.0, samples.direction[k], samples.velocity_rad_per_s[k] / rms];
    let design = Design::of(samples.len(), CARRIERS * (1 + DEGREES), |k, row| {
        let trends = legendre(2.0 * samples.time_s[k] / end_s - 1.0);
        for (degree, trend) in trends.into_iter().enumerate() {
            let at = |(c, carrier): (usize, f64)| (degree * CARRIERS + c, carrier * trend);
            row.extend(carriers(k).into_iter().enumerate().map(at));
        }
    });
    let fit = Fit::of(&design, &samples.residual_v, &folds(samples, end_s));
    let base: Vec<usize> = (0..CARRIERS).collect();
    let of_carrier = |c: usize| (1..=DEGREES).map(move |degree| degree * CARRIERS + c);
    let with = |c: usize| base.iter().copied().chain(of_carrier(c)).collect::<Vec<usize>>();
    let gains = [0, 1, 2].map(|c| fit.gain(&base, &with(c)));
    let all: Vec<usize> = (0..CARRIERS * (1 + DEGREES)).collect();
    let all_v2 = fit.gain(&base, &all);
    let best = (0..CARRIERS).max_by(|&a, &b| gains[a].total_cmp(&gains[b]))?;
    let columns = if all_v2 > gains[best] { all } else { with(best) };
    let mut trend = fit.coefficients(&columns);
    let change_v = change(&|degree| trend[degree * CARRIERS + best]);
    base.iter().for_each(|&column| trend[column] = 0.0);
    let energy_v2 = all_v2.max(gains[best]);
    let detail = words(best, change_v, end_s);
    Some(Found { axis: Axis::Time, energy_v2, detail, fitted_v: design.times(&trend) })
}

fn legendre(x: f64) -> [f64; DEGREES + 1] {
    [1.0, x, 1.5 * x * x - 0.5, 2.5 * x * x * x - 1.5 * x]
}

/// From the beginning to the end.
fn change(coefficient: &dyn Fn(usize) -> f64) -> f64 {
    2.0 * (coefficient(1) + coefficient(3))
}

fn words(carrier: usize, change_v: f64, end_s: f64) -> String {
    let sense = if change_v > 0.0 { "grows" } else { "falls" };
    let (size, over) = (volts(change_v.abs()), format!("{end_s:.0} s"));
    match carrier {
        0 => format!("a slow trend: {sense} by {size} in {over}"),
        1 => format!("dry friction {sense} by {size} in {over}"),
        _ => format!("viscous friction {sense} by {size} in {over} at the rms velocity"),
    }
}

/// One log after the other is left out where two or more are long enough to tell, else the usual
/// stretches.
fn folds(samples: &Samples, end_s: f64) -> Vec<usize> {
    let logs = samples.log.iter().max().map_or(0, |last| last + 1);
    let mut lengths = vec![0.0f64; logs];
    for (&log, &time_s) in samples.log.iter().zip(&samples.time_s) {
        lengths[log] = lengths[log].max(time_s);
    }
    let long = lengths.iter().filter(|&&length| length > 0.5 * end_s).count();
    if long < 2 { samples.fold.clone() } else { samples.log.clone() }
}
