//! What lies at certain frequencies, lines and bands, and is no function of anything else.

use super::found::Found;
use super::samples::Samples;
use super::spectrum::{Spectrum, spectrum};
use crate::criteria::AxisCriteria;
use crate::quantity::number;
use crate::result::Axis;

/// A line or a band of frequencies.
struct Part {
    energy_v2: f64,
    words: String,
}

/// Lines and a band in what the other axes leave; `others` is the part of the excess that they
/// explain.
///
/// Frequencies of the motion itself say nothing of their own: a line there must be sharper
/// than the motion's, and a band counts only where no other axis explains much.
pub(super) fn find(samples: &Samples, others: f64) -> Option<Found> {
    let mut left = spectrum(samples, &samples.residual_v)?;
    let motion = spectrum(samples, &samples.velocity_rad_per_s)?;
    // Some of a segment's values weigh more than others: the sum of squares sets the scale.
    let scale = samples.len() as f64 * left.step_hz();
    let floor = samples.floor_v2 / (scale * left.density.len() as f64);
    let criteria = &samples.criteria;
    let mut parts = take_lines(&mut left, &motion, scale, criteria);
    parts.extend(band(&left, &motion, floor, others, criteria).map(|band| band.scaled(scale)));
    parts.sort_by(|a, b| b.energy_v2.total_cmp(&a.energy_v2));
    let energy_v2: f64 = parts.iter().map(|part| part.energy_v2).sum();
    parts.retain(|part| part.energy_v2 > criteria.least_line_part * energy_v2);
    let words: Vec<String> = parts.into_iter().map(|part| part.words).collect();
    let fitted_v = vec![0.0; samples.len()];
    let detail = words.join("; ");
    (energy_v2 > 0.0).then_some(Found { axis: Axis::Frequency, energy_v2, detail, fitted_v })
}

impl Part {
    fn scaled(self, scale: f64) -> Self {
        Self { energy_v2: self.energy_v2 * scale, ..self }
    }
}

/// A window smears a line over this many frequencies to either side.
const SMEAR: usize = 3;
const NEIGHBOURS: usize = 16;

/// Takes the lines out of a spectrum, the strongest first.
fn take_lines(
    left: &mut Spectrum,
    motion: &Spectrum,
    scale: f64,
    criteria: &AxisCriteria,
) -> Vec<Part> {
    let motion_hz = motion.frequency_of_part(criteria.motion_part);
    let mut lines = Vec::new();
    let inside = SMEAR + 1..left.density.len().saturating_sub(SMEAR + 1);
    let mut asked: Vec<usize> = inside.collect();
    asked.sort_by(|&a, &b| left.density[b].total_cmp(&left.density[a]));
    for bin in asked {
        if lines.len() == criteria.most_lines {
            break;
        }
        let Some(about) = background(&left.density, bin) else { continue };
        let height = left.density[bin] / about;
        let of_motion = background(&motion.density, bin);
        let sharper = of_motion.is_none_or(|of_motion| {
            height > criteria.line_over_motion * motion.density[bin] / of_motion
        });
        let own = left.frequency_hz[bin] > motion_hz || sharper;
        if height > criteria.line_ratio && own {
            lines.push(take_line(left, bin, about, scale));
        }
    }
    lines
}

fn take_line(left: &mut Spectrum, bin: usize, about: f64, scale: f64) -> Part {
    let bins = bin - SMEAR..=bin + SMEAR;
    let power: f64 = bins.clone().map(|k| (left.density[k] - about).max(0.0)).sum();
    let moment: f64 =
        bins.clone().map(|k| (left.density[k] - about).max(0.0) * left.frequency_hz[k]).sum();
    left.density[bins].fill(about);
    Part { energy_v2: power * scale, words: format!("a line at {:.1} Hz", moment / power) }
}

/// The median density about a frequency, but for its own line; none where the spectrum
/// is too short.
fn background(density: &[f64], bin: usize) -> Option<f64> {
    let range = bin.saturating_sub(NEIGHBOURS)..(bin + NEIGHBOURS + 1).min(density.len());
    let mut about: Vec<f64> =
        range.filter(|k| k.abs_diff(bin) > SMEAR).map(|k| density[k]).collect();
    let middle = about.len() / 2;
    let median = |about: &mut Vec<f64>| *about.select_nth_unstable_by(middle, f64::total_cmp).1;
    (!about.is_empty()).then(|| median(&mut about).max(f64::MIN_POSITIVE))
}

/// The band in which the density stands out from the floor, in units of the density.
fn band(
    left: &Spectrum,
    motion: &Spectrum,
    floor: f64,
    others: f64,
    criteria: &AxisCriteria,
) -> Option<Part> {
    let excess: Vec<f64> = left.density.iter().map(|density| density - floor).collect();
    let whole: f64 = excess.iter().sum();
    if whole <= 0.0 {
        return None;
    }
    let level = 0.5 * whole / excess.len() as f64;
    let (from, to) = heaviest_run(&excess, level);
    let energy: f64 = excess[from..to].iter().sum();
    let (low_hz, high_hz) = (left.frequency_hz[from], left.frequency_hz[to - 1]);
    let of_motion = low_hz < motion.frequency_of_part(criteria.motion_part);
    let wide = high_hz - low_hz > criteria.widest_band_part * left.highest_hz() && of_motion;
    if wide || energy < 0.5 * whole || (of_motion && others > criteria.explained_elsewhere) {
        return None;
    }
    let above: f64 = excess[to..].iter().map(|e| e.max(0.0)).sum();
    let words = if of_motion {
        format!("below {} Hz", number(high_hz))
    } else if above < 0.05 * whole && high_hz > 2.0 * low_hz {
        format!("above {} Hz", number(low_hz))
    } else {
        format!("{} to {} Hz", number(low_hz), number(high_hz))
    };
    // Noise that is not white must not count as more than there is.
    Some(Part { energy_v2: energy.min(whole), words })
}

/// The run whose sum above a level is largest (Kadane), from and to before.
fn heaviest_run(values: &[f64], level: f64) -> (usize, usize) {
    let (mut best, mut range) = (f64::NEG_INFINITY, (0, values.len()));
    let (mut sum, mut start) = (0.0, 0);
    for (k, value) in values.iter().enumerate() {
        if sum <= 0.0 {
            (sum, start) = (0.0, k);
        }
        sum += value - level;
        if sum > best {
            (best, range) = (sum, (start, k + 1));
        }
    }
    range
}
