//! The paper's smoothing: a Butterworth low-pass run forwards and backwards.

use std::f64::consts::PI;

/// A fourth-order Butterworth low-pass for evenly sampled signals, as two biquads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowPass {
    sections: [Biquad; 2],
    /// Pole of a first-order low-pass before them; 0 for none.
    pole: f64,
    /// Samples until what came before is forgotten to 1e-4.
    memory: usize,
}

/// A second-order section, direct form II transposed.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Biquad {
    gain: f64,
    a1: f64,
    a2: f64,
}

impl LowPass {
    /// The filter whose gain is 1/sqrt(2) at `cutoff_hz`, one way.
    ///
    /// A cut-off at or above 0.45 of the sampling frequency is taken as that.
    pub fn new(cutoff_hz: f64, period_s: f64) -> Self {
        let relative = (cutoff_hz * period_s).min(0.45);
        // The poles of the fourth order lie in pairs at 22.5 and 67.5 degrees.
        let quality = |degrees: f64| 0.5 / degrees.to_radians().cos();
        Self {
            sections: [22.5, 67.5].map(|degrees| Biquad::low_pass(relative, quality(degrees))),
            pole: 0.0,
            memory: (3.0 / relative).ceil() as usize,
        }
    }

    /// The same behind a first-order low-pass of this corner, gain 1/2 there both ways.
    pub fn behind_first_order(self, corner_hz: f64, period_s: f64) -> Self {
        let pole = (-2.0 * PI * corner_hz * period_s).exp();
        let memory = (10.0 / (1.0 - pole)).ceil() as usize;
        Self { pole, memory: self.memory.max(memory), ..self }
    }

    /// The signal filtered forwards and backwards: no phase, the gain squared.
    ///
    /// Beyond its ends the signal is continued by its own image turned about the end
    /// point, which keeps value and slope, so that nothing rings there.
    pub fn zero_phase(&self, signal: &[f64]) -> Vec<f64> {
        let padding = self.memory.min(signal.len().saturating_sub(1));
        let mut work = padded(signal, padding);
        self.run(work.iter_mut());
        self.run(work.iter_mut().rev());
        work.truncate(padding + signal.len());
        work.drain(..padding);
        work
    }

    /// One pass in place, begun as if the first value had always been there.
    fn run<'a>(&self, mut signal: impl Iterator<Item = &'a mut f64>) {
        let Some(start) = signal.next() else { return };
        let [first, second] = self.sections;
        let mut level = *start;
        let (mut s, mut t) = (first.at_rest(level), second.at_rest(level));
        let keep = 1.0 - self.pole;
        let mut pass = |value: &mut f64| {
            level += keep * (*value - level);
            *value = second.step(first.step(level, &mut s), &mut t);
        };
        pass(start);
        signal.for_each(pass);
    }

    /// Gain of both passes together at a frequency.
    pub fn gain(&self, frequency_hz: f64, period_s: f64) -> f64 {
        let angle = 2.0 * PI * frequency_hz * period_s;
        let keep = 1.0 - self.pole;
        let first = keep * keep / (1.0 - 2.0 * self.pole * angle.cos() + self.pole * self.pole);
        first * self.sections.iter().map(|section| section.power_gain(angle)).product::<f64>()
    }

    /// Samples after an end or a disturbance until it is forgotten.
    pub fn memory(&self) -> usize {
        self.memory
    }
}

impl Biquad {
    /// By the bilinear transform with the cut-off in place.
    fn low_pass(relative_cutoff: f64, quality: f64) -> Self {
        let w = (PI * relative_cutoff).tan();
        let scale = 1.0 / (1.0 + w / quality + w * w);
        Self {
            gain: w * w * scale,
            a1: 2.0 * (w * w - 1.0) * scale,
            a2: (1.0 - w / quality + w * w) * scale,
        }
    }

    /// State after a constant input of all times.
    fn at_rest(&self, level: f64) -> [f64; 2] {
        let second = level * (self.gain - self.a2);
        [level * (2.0 * self.gain - self.a1) + second, second]
    }

    #[inline(always)]
    fn step(&self, input: f64, state: &mut [f64; 2]) -> f64 {
        let scaled = self.gain * input;
        let output = scaled + state[0];
        state[0] = 2.0 * scaled - self.a1 * output + state[1];
        state[1] = scaled - self.a2 * output;
        output
    }

    fn power_gain(&self, angle: f64) -> f64 {
        let (cos, cos2) = (angle.cos(), (2.0 * angle).cos());
        let (sin, sin2) = (angle.sin(), (2.0 * angle).sin());
        let top = self.gain * (2.0 + 2.0 * cos);
        let real = 1.0 + self.a1 * cos + self.a2 * cos2;
        let imaginary = self.a1 * sin + self.a2 * sin2;
        top * top / (real * real + imaginary * imaginary)
    }
}

/// The signal with its own image, turned about the end points, before and after it.
fn padded(signal: &[f64], padding: usize) -> Vec<f64> {
    let (Some(&first), Some(&last)) = (signal.first(), signal.last()) else { return Vec::new() };
    let end = signal.len() - 1;
    let before = (1..=padding).rev().map(|k| 2.0 * first - signal[k]);
    let after = (1..=padding).map(|k| 2.0 * last - signal[end - k]);
    before.chain(signal.iter().copied()).chain(after).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERIOD_S: f64 = 1e-3;

    fn sine(frequency_hz: f64, samples: usize) -> Vec<f64> {
        (0..samples).map(|k| (2.0 * PI * frequency_hz * k as f64 * PERIOD_S).sin()).collect()
    }

    #[test]
    fn a_sine_keeps_its_phase_and_takes_the_squared_gain() {
        let filter = LowPass::new(20.0, PERIOD_S);
        for frequency_hz in [1.0, 10.0, 20.0, 40.0] {
            let signal = sine(frequency_hz, 4000);
            let filtered = filter.zero_phase(&signal);
            // Butterworth: |H|^2 = 1 / (1 + (tan ratio)^8).
            let ratio = (PI * frequency_hz * PERIOD_S).tan() / (PI * 20.0 * PERIOD_S).tan();
            let expected = 1.0 / (1.0 + ratio.powi(8));
            assert!((filter.gain(frequency_hz, PERIOD_S) - expected).abs() < 1e-12);
            for k in 1000..3000 {
                assert!((filtered[k] - expected * signal[k]).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn a_ramp_passes_unharmed_to_its_ends() {
        let ramp: Vec<f64> = (0..500).map(|k| 3.0 + 0.01 * f64::from(k)).collect();
        let filtered = LowPass::new(10.0, PERIOD_S).zero_phase(&ramp);
        let error = ramp.iter().zip(&filtered).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(error < 2e-4, "{error:e}");
    }

    #[test]
    fn short_signals_are_no_trouble() {
        let filter = LowPass::new(10.0, PERIOD_S);
        assert!(filter.zero_phase(&[]).is_empty());
        assert_eq!(filter.zero_phase(&[2.0]).len(), 1);
        assert!((filter.zero_phase(&[2.0, 2.0, 2.0])[1] - 2.0).abs() < 1e-12);
    }
}
