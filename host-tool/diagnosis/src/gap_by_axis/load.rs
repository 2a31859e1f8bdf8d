//! What varies with the load.

use super::curve::{Curve, curve};
use super::found::Found;
use super::samples::Samples;
use super::shape::{explained, spread};
use crate::quantity::{number, volts};
use crate::result::Axis;

/// A function of the load, whatever the motion, or one of its size that opposes the motion.
pub(super) fn find(samples: &Samples) -> Option<Found> {
    let size: Vec<f64> = samples.load_nm.iter().map(|load| load.abs()).collect();
    let pushing = curve(samples, &samples.load_nm, None);
    let rubbing = curve(samples, &size, Some(&samples.direction));
    let (Curve { energy_v2, fitted_v }, detail) = if pushing.energy_v2 > rubbing.energy_v2 {
        let words = pushing_words(&pushing.fitted_v, samples);
        (pushing, words)
    } else {
        let words = rubbing_words(&rubbing.fitted_v, &size, samples);
        (rubbing, words)
    };
    Some(Found { axis: Axis::Load, energy_v2, detail, fitted_v })
}

fn pushing_words(fitted_v: &[f64], samples: &Samples) -> String {
    let (share, slope) = explained(fitted_v, |k| samples.load_nm[k]);
    if share > samples.criteria.clear_part {
        let sense = if slope > 0.0 { "grows" } else { "falls" };
        format!("{sense} with the load, {} mV/Nm", number(1e3 * slope))
    } else {
        format!("varies with the load by {}", volts(spread(fitted_v)))
    }
}

fn rubbing_words(fitted_v: &[f64], size: &[f64], samples: &Samples) -> String {
    let (share, slope) = explained(fitted_v, |k| size[k] * samples.direction[k]);
    if share > samples.criteria.clear_part {
        let sense = if slope > 0.0 { "grows" } else { "falls" };
        format!("friction {sense} with |load|, {} mV/Nm", number(1e3 * slope))
    } else {
        "friction varies with |load|".into()
    }
}
