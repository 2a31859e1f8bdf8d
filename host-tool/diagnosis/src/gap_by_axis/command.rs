//! What varies with the command.

use super::curve::{Curve, curve};
use super::found::Found;
use super::samples::Samples;
use super::shape::{explained, spread};
use crate::quantity::volts;
use crate::result::Axis;

/// A function of the command.
pub(super) fn find(samples: &Samples) -> Option<Found> {
    let Curve { energy_v2, fitted_v } = curve(samples, &samples.command_v, None);
    let detail = words(&fitted_v, samples);
    Some(Found { axis: Axis::Command, energy_v2, detail, fitted_v })
}

fn words(fitted_v: &[f64], samples: &Samples) -> String {
    let (command, clear) = (&samples.command_v, samples.criteria.clear_part);
    let (beyond, limit_v) = best_limit(samples);
    let (linear, slope) = explained(fitted_v, |k| command[k]);
    let (sign, level_v) = explained(fitted_v, |k| command[k].signum());
    let beyond = beyond / explained_part(fitted_v, samples).max(f64::MIN_POSITIVE);
    if beyond > linear.max(sign).max(clear) {
        format!("only beyond |u| = {}", volts(limit_v))
    } else if linear > clear && linear >= sign {
        format!("proportional to the command, {:+.1} %", 100.0 * slope)
    } else if sign > clear {
        format!("with the sign of the command, {}", volts(level_v))
    } else {
        format!("varies with the command by {}", volts(spread(fitted_v)))
    }
}

/// Part of the residual's square that the function explains.
fn explained_part(fitted_v: &[f64], samples: &Samples) -> f64 {
    explained(&samples.residual_v, |k| fitted_v[k]).0
}

/// The limit beyond which a ramp explains most of the residual's square, and that part; a limit
/// that most samples are beyond is none.
fn best_limit(samples: &Samples) -> (f64, f64) {
    let (steps, criteria) = (samples.criteria.command_limits, &samples.criteria);
    let mut sizes: Vec<f64> = samples.command_v.iter().map(|u| u.abs()).collect();
    sizes.sort_unstable_by(f64::total_cmp);
    let last = sizes.len() - 1;
    let from = sizes[((1.0 - criteria.most_beyond_limit) * last as f64) as usize];
    let most = sizes[last];
    let part = |limit_v: f64| {
        let ramp = |k: usize| {
            let u: f64 = samples.command_v[k];
            u.signum() * (u.abs() - limit_v).max(0.0)
        };
        (explained(&samples.residual_v, ramp).0, limit_v)
    };
    (0..steps)
        .map(|step| part(from + (most - from) * step as f64 / steps as f64))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap_or((0.0, from))
}
