//! The spectrum over time of one joint's values, over all logs.

use super::samples::Samples;
use signal::spectrum::Welch;

/// A one-sided spectral density.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Spectrum {
    /// Frequencies [Hz], from 0 in equal steps.
    pub frequency_hz: Vec<f64>,
    /// Density [unit of the values squared per Hz].
    pub density: Vec<f64>,
}

/// The density of values, one per sample, averaged over all logs; `None` where no log is long
/// enough.
pub fn spectrum(samples: &Samples, values: &[f64]) -> Option<Spectrum> {
    let period_s = typical_period_s(samples)?;
    let longest = logs(samples).map(|(start, end)| end - start).max()?;
    let segment_samples = (samples.criteria.segment_s / period_s) as usize;
    let segment_samples = segment_samples.min(longest / 2).min(samples.criteria.longest_segment);
    let welch = Welch {
        segment_samples: segment_samples & !1,
        most_segments: usize::MAX,
        detrend: false,
        ..Welch::default()
    };
    let mut sum = Spectrum::default();
    let mut segments = 0.0;
    for (start, end) in logs(samples) {
        let starts = welch.segments(&samples.time_s[start..end], period_s);
        let Some(spectra) = welch.spectra(&[&values[start..end]], &starts, period_s) else {
            continue;
        };
        let count = starts.len() as f64;
        sum.density.resize(spectra.bins(), 0.0);
        (0..spectra.bins()).for_each(|bin| sum.density[bin] += count * spectra.auto(bin, 0));
        sum.frequency_hz = spectra.frequency_hz;
        segments += count;
    }
    sum.density.iter_mut().for_each(|density| *density /= segments);
    (segments > 0.0).then_some(sum)
}

impl Spectrum {
    /// Distance between frequencies [Hz].
    pub fn step_hz(&self) -> f64 {
        self.frequency_hz.get(1).copied().unwrap_or(0.0)
    }

    /// Half the sampling frequency [Hz].
    pub fn highest_hz(&self) -> f64 {
        self.frequency_hz.last().copied().unwrap_or(0.0)
    }

    /// The frequency below which this part of the power lies [Hz].
    pub fn frequency_of_part(&self, part: f64) -> f64 {
        let whole: f64 = self.density.iter().sum();
        let mut sum = 0.0;
        let reached = self.density.iter().position(|density| {
            sum += density;
            sum >= part * whole
        });
        reached.map_or(0.0, |bin| self.frequency_hz[bin])
    }
}

/// Where each log's samples begin and end.
fn logs(samples: &Samples) -> impl Iterator<Item = (usize, usize)> + '_ {
    let mut start = 0;
    samples.log.chunk_by(|a, b| a == b).map(move |chunk| {
        let range = (start, start + chunk.len());
        start = range.1;
        range
    })
}

/// The median time between samples of the same log [s].
fn typical_period_s(samples: &Samples) -> Option<f64> {
    let pairs = samples.time_s.windows(2).map(|pair| pair[1] - pair[0]);
    let mut steps: Vec<f64> = pairs.filter(|&step| step > 0.0).collect();
    let middle = steps.len() / 2;
    (!steps.is_empty()).then(|| *steps.select_nth_unstable_by(middle, f64::total_cmp).1)
}
