//! Averaged auto and cross spectra of several signals (Welch's method).

use nalgebra::Complex;
use realfft::RealFftPlanner;

use super::spectrum_window::{hann, without_trend};

/// How spectra are averaged. The default is the paper's: Hann, 4096 samples, half overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Welch {
    /// Samples per segment.
    pub segment_samples: usize,
    /// Part of a segment that the next one shares, 0 to below 1.
    pub overlap: f64,
    /// At most so many segments are averaged, the first ones of the log.
    pub most_segments: usize,
    /// Removes each segment's least-squares line (drift); otherwise only its mean.
    pub detrend: bool,
}

impl Default for Welch {
    fn default() -> Self {
        Self { segment_samples: 4096, overlap: 0.5, most_segments: 50, detrend: true }
    }
}

impl Welch {
    /// The first samples of segments in which the samples are evenly spaced.
    ///
    /// `time_s` may have gaps: no segment spans one.
    pub fn segments(&self, time_s: &[f64], period_s: f64) -> Vec<usize> {
        let length = self.segment_samples;
        let mut starts = Vec::new();
        let mut start = 0;
        while length > 1 && start + length <= time_s.len() && starts.len() < self.most_segments {
            let span_s = time_s[start + length - 1] - time_s[start];
            let whole = (span_s - (length - 1) as f64 * period_s).abs() < 0.5 * period_s;
            if whole {
                starts.push(start);
            }
            start += if whole { self.step() } else { length.div_ceil(16) };
        }
        starts
    }

    /// From segment to segment [samples].
    fn step(&self) -> usize {
        let step = self.segment_samples as f64 * (1.0 - self.overlap);
        (step.round() as usize).max(1)
    }

    /// Spectra of signals of the same length over the segments that begin at `starts`.
    ///
    /// `None` without a signal, without a segment, or with one that ends after the signals.
    pub fn spectra(&self, signals: &[&[f64]], starts: &[usize], period_s: f64) -> Option<Spectra> {
        let length = self.segment_samples;
        let last = starts.iter().max()?;
        if signals.is_empty() || length < 2 || signals.iter().any(|s| s.len() < last + length) {
            return None;
        }
        let window = hann(length);
        let transform = RealFftPlanner::<f64>::new().plan_fft_forward(length);
        let mut spectra = Spectra::empty(signals.len(), length, period_s);
        let mut transformed = vec![transform.make_output_vec(); signals.len()];
        for &start in starts {
            for (signal, output) in signals.iter().zip(&mut transformed) {
                let mut piece = without_trend(&signal[start..start + length], self.detrend);
                piece.iter_mut().zip(&window).for_each(|(x, w)| *x *= w);
                transform.process(&mut piece, output).ok()?;
            }
            spectra.add(&transformed);
        }
        let power: f64 = window.iter().map(|w| w * w).sum();
        spectra.scale(2.0 * period_s / (power * starts.len() as f64));
        spectra.independent_averages = independent_averages(&window, self.step(), starts.len());
        spectra.neighbour_inflation = neighbour_inflation(&window);
        Some(spectra)
    }
}

/// One-sided spectral densities of signals, each with each, by frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Spectra {
    /// Frequencies [Hz], from 0.
    pub frequency_hz: Vec<f64>,
    /// How many segments without overlap would average as well.
    pub independent_averages: f64,
    /// How much larger the variance of a sum over neighbouring frequencies is than if
    /// their errors were independent; the window correlates them (Hann: 1.94).
    pub neighbour_inflation: f64,
    signals: usize,
    density: Vec<Complex<f64>>,
}

impl Spectra {
    fn empty(signals: usize, length: usize, period_s: f64) -> Self {
        let bins = length / 2 + 1;
        let step_hz = 1.0 / (length as f64 * period_s);
        Self {
            frequency_hz: (0..bins).map(|bin| bin as f64 * step_hz).collect(),
            independent_averages: 0.0,
            neighbour_inflation: 1.0,
            signals,
            density: vec![Complex::default(); bins * signals * signals],
        }
    }

    fn add(&mut self, transformed: &[Vec<Complex<f64>>]) {
        let count = self.signals;
        for (bin, block) in self.density.chunks_exact_mut(count * count).enumerate() {
            for a in 0..count {
                for b in 0..count {
                    block[a * count + b] += transformed[a][bin] * transformed[b][bin].conj();
                }
            }
        }
    }

    fn scale(&mut self, factor: f64) {
        self.density.iter_mut().for_each(|density| *density *= factor);
    }

    /// How many frequencies there are.
    pub fn bins(&self) -> usize {
        self.frequency_hz.len()
    }

    /// Distance between frequencies [Hz].
    pub fn step_hz(&self) -> f64 {
        self.frequency_hz.get(1).copied().unwrap_or(0.0)
    }

    /// Cross spectrum, mean of A conj(B) [unit of a times unit of b per Hz].
    pub fn cross(&self, bin: usize, a: usize, b: usize) -> Complex<f64> {
        self.density[(bin * self.signals + a) * self.signals + b]
    }

    /// Auto spectrum [unit^2/Hz].
    pub fn auto(&self, bin: usize, signal: usize) -> f64 {
        self.cross(bin, signal, signal).re
    }

    /// H1 estimate of the FRF from `input` to `output`: noise on the output averages out.
    pub fn frf(&self, bin: usize, input: usize, output: usize) -> Complex<f64> {
        self.cross(bin, output, input) / self.auto(bin, input)
    }

    /// Closed-loop (instrumental) estimate of the FRF from `input` to `output`: noise
    /// that feedback carries from one to the other averages out, because the
    /// loop's reference is independent of it.
    pub fn frf_by_reference(
        &self,
        bin: usize,
        reference: usize,
        input: usize,
        output: usize,
    ) -> Complex<f64> {
        self.cross(bin, output, reference) / self.cross(bin, input, reference)
    }

    /// Ordinary coherence of two signals, 0 to 1.
    pub fn coherence(&self, bin: usize, a: usize, b: usize) -> f64 {
        let power = self.auto(bin, a) * self.auto(bin, b);
        if power > 0.0 { (self.cross(bin, a, b).norm_sqr() / power).min(1.0) } else { 0.0 }
    }

    /// Multiple coherence, 0 to 1: the part of `output`'s power that all `inputs`
    /// together explain linearly. 0 where the inputs are linearly dependent.
    pub fn multiple_coherence(&self, bin: usize, inputs: &[usize], output: usize) -> f64 {
        let n = inputs.len();
        let matrix = nalgebra::DMatrix::from_fn(n, n, |r, c| self.cross(bin, inputs[r], inputs[c]));
        let cross = nalgebra::DVector::from_fn(n, |r, _| self.cross(bin, inputs[r], output));
        let explained = matrix.lu().solve(&cross).map_or(0.0, |gain| gain.dotc(&cross).re);
        let share = explained / self.auto(bin, output);
        if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }
    }
}

/// Welch's formula: overlapping segments are correlated by their common windows.
fn independent_averages(window: &[f64], step: usize, segments: usize) -> f64 {
    let power: f64 = window.iter().map(|w| w * w).sum();
    let count = segments as f64;
    let correlation = |lag: usize| -> f64 {
        let common: f64 =
            window.iter().zip(window.iter().skip(lag * step)).map(|(a, b)| a * b).sum();
        (common / power).powi(2)
    };
    let lags = (window.len() / step.max(1)).min(segments.saturating_sub(1));
    let spread: f64 = (1..=lags).map(|lag| (1.0 - lag as f64 / count) * correlation(lag)).sum();
    count / (1.0 + 2.0 * spread)
}

/// Sum of the squared correlations of a frequency's error with all the others'.
fn neighbour_inflation(window: &[f64]) -> f64 {
    let energy: f64 = window.iter().map(|w| w.powi(4)).sum();
    let power: f64 = window.iter().map(|w| w * w).sum();
    energy * window.len() as f64 / (power * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Repeatable white noise of variance one.
    fn white(samples: usize, seed: u64) -> Vec<f64> {
        use rand_distr::{Distribution, StandardNormal};
        let mut random = rand_pcg::Pcg64Mcg::new(u128::from(seed) << 1 | 1);
        (0..samples).map(|_| StandardNormal.sample(&mut random)).collect()
    }

    fn spectra_of(signals: &[&[f64]]) -> Spectra {
        let welch = Welch::default();
        let time_s: Vec<f64> = (0..signals[0].len()).map(|k| k as f64 * 1e-3).collect();
        welch.spectra(signals, &welch.segments(&time_s, 1e-3), 1e-3).unwrap()
    }

    #[test]
    fn the_density_of_white_noise_integrates_to_its_power() {
        let noise = white(104_448, 1);
        let spectra = spectra_of(&[&noise]);
        let power: f64 = (0..spectra.bins()).map(|bin| spectra.auto(bin, 0)).sum();
        assert!((power * spectra.step_hz() - 1.0).abs() < 0.02);
        assert!((spectra.independent_averages - 47.4).abs() < 0.2);
        assert!((spectra.neighbour_inflation - 35.0 / 18.0).abs() < 1e-9);
    }

    #[test]
    fn a_delayed_and_scaled_signal_gives_its_frf() {
        let noise = white(104_448, 2);
        let delayed: Vec<f64> =
            (0..noise.len()).map(|k| if k < 3 { 0.0 } else { 0.5 * noise[k - 3] }).collect();
        let spectra = spectra_of(&[&noise, &delayed]);
        let bin = 400;
        let phase = -std::f64::consts::TAU * spectra.frequency_hz[bin] * 3e-3;
        assert!((spectra.frf(bin, 0, 1) - Complex::from_polar(0.5, phase)).norm() < 5e-3);
        assert!(spectra.coherence(bin, 0, 1) > 0.999);
    }

    #[test]
    fn the_reference_sees_through_noise_that_feedback_carries() {
        let (reference, noise) = (white(104_448, 3), white(104_448, 4));
        let input: Vec<f64> = reference.iter().zip(&noise).map(|(r, n)| r - n).collect();
        let output: Vec<f64> = input.iter().zip(&noise).map(|(u, n)| u + n).collect();
        let spectra = spectra_of(&[&reference, &input, &output]);
        let mean = |frf: &dyn Fn(usize) -> Complex<f64>| -> f64 {
            (100..1900).map(|bin| frf(bin).re).sum::<f64>() / 1800.0
        };
        assert!((mean(&|bin| spectra.frf(bin, 1, 2)) - 0.5).abs() < 0.02, "H1 is biased");
        assert!((mean(&|bin| spectra.frf_by_reference(bin, 0, 1, 2)) - 1.0).abs() < 0.05);
    }

    #[test]
    fn two_inputs_explain_what_one_does_not() {
        let (a, b) = (white(104_448, 5), white(104_448, 6));
        let sum: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a + b).collect();
        let spectra = spectra_of(&[&a, &b, &sum]);
        let mean = |f: &dyn Fn(usize) -> f64| (100..1900).map(f).sum::<f64>() / 1800.0;
        assert!((mean(&|bin| spectra.coherence(bin, 0, 2)) - 0.5).abs() < 0.03);
        assert!(mean(&|bin| spectra.multiple_coherence(bin, &[0, 1], 2)) > 0.999);
    }

    #[test]
    fn no_segment_spans_a_gap() {
        let welch = Welch { segment_samples: 64, ..Welch::default() };
        let mut time_s: Vec<f64> = (0..300).map(|k| k as f64 * 1e-3).collect();
        time_s[150..].iter_mut().for_each(|t| *t += 0.02);
        let starts = welch.segments(&time_s, 1e-3);
        assert!(starts.len() >= 5);
        assert!(starts.iter().all(|&start| start + 63 < 150 || start >= 150), "{starts:?}");
    }
}
