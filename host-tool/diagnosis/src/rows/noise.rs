//! The noise floor, from what the logs leave where nothing structured is.
//!
//! Noise of the amplifier is white over frequency, that of the encoder's steps grows with
//! its fourth power once positions are differentiated twice. Both are read off the quietest
//! quarter of short pieces of the residual, frequency by frequency: whatever comes and goes
//! with the motion is not in it. Where it comes in half of the pieces, powers are found up
//! to 2.6 times too large.

use std::f64::consts::{PI, TAU};

use realfft::RealFftPlanner;

use crate::criteria::RowCriteria;
use crate::logs::stretch::Stretch;

/// Power density of noise, a + b f^4 [V^2/Hz], one-sided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Noise {
    /// Its white part.
    pub white: f64,
    /// Its part that grows, per Hz^4.
    pub growing: f64,
}

/// The noise of the joints at each of the rates at which logs are sampled: an amplifier
/// or encoder that is sampled twice as often spreads its noise over twice the band.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NoiseByRate {
    /// Sample periods [s] with the noise of each joint of the arm.
    rates: Vec<(f64, Vec<Option<Noise>>)>,
    /// The part of the encoder's steps alone.
    steps: Vec<(f64, Vec<f64>)>,
    /// What the jitter of the sampling adds per mean square of the speed.
    jitter: Vec<(f64, Vec<f64>)>,
}

/// Noise of a joint that has none, or of which nothing is known.
const NOTHING: Noise = Noise { white: 1e-12, growing: 1e-18 };

impl NoiseByRate {
    /// Adds what was seen of each joint at a sample period [s].
    ///
    /// What encoder steps add to each, per Hz^4, is known beforehand: an encoder that stands
    /// still shows none of what its steps add once it moves.
    pub fn push(&mut self, period_s: f64, noise: &[Option<Noise>], steps: Vec<f64>) {
        let joint = |i: usize| noise[i].map(|noise| noise.growing_at_least(steps[i]));
        self.rates.push((period_s, (0..noise.len()).map(joint).collect()));
        self.steps.push((period_s, steps));
    }

    /// Adds what a clock that jitters adds to each joint at a sample period [s], per Hz^4 and per
    /// rad^2/s^2 of its mean square speed.
    pub fn push_jitter(&mut self, period_s: f64, jitter: Vec<f64>) {
        self.jitter.push((period_s, jitter));
    }

    /// What encoder steps alone make at a sample period [s].
    pub fn of_steps(&self, joint: usize, period_s: f64) -> Noise {
        Noise { white: 0.0, growing: at_nearest_rate(&self.steps, joint, period_s) }
    }

    /// Whether anything was seen of a joint (from 0).
    pub fn knows(&self, joint: usize) -> bool {
        self.rates.iter().any(|(_, noise)| noise[joint].is_some())
    }

    /// The noise of a joint (from 0) at a sample period [s], from the nearest rate at which
    /// it was seen.
    pub fn of(&self, joint: usize, period_s: f64) -> Noise {
        let apart = |rate_s: f64| (rate_s / period_s).ln().abs();
        let seen = self.rates.iter().filter_map(|(rate_s, noise)| Some((*rate_s, noise[joint]?)));
        let nearest = seen.min_by(|a, b| apart(a.0).total_cmp(&apart(b.0)));
        nearest.map_or(NOTHING, |(rate_s, noise)| noise.at_another_rate(period_s / rate_s))
    }

    /// The noise of a joint in a stretch: that of its rate, and at least what the jitter of the
    /// sampling makes at its speeds there.
    pub fn in_stretch(&self, joint: usize, stretch: &Stretch) -> Noise {
        let period_s = stretch.sampled_s;
        let speed = signal::rms(&stretch.motion.qd_rad_per_s[joint]);
        let jitter = speed * speed * at_nearest_rate(&self.jitter, joint, period_s);
        let steps = self.of_steps(joint, period_s).growing;
        let noise = self.of(joint, period_s);
        if jitter > 0.0 { noise.growing_at_least(steps + jitter) } else { noise }
    }
}

/// A density of a joint at the nearest of the rates at which it is known.
fn at_nearest_rate(rates: &[(f64, Vec<f64>)], joint: usize, period_s: f64) -> f64 {
    let apart = |rate_s: f64| (rate_s / period_s).ln().abs();
    let nearest = rates.iter().min_by(|a, b| apart(a.0).total_cmp(&apart(b.0)));
    nearest.map_or(0.0, |(rate_s, of_joints)| of_joints[joint] * period_s / rate_s)
}

impl Noise {
    /// The noise in residuals, one per stretch, all of the same period; `None` where there
    /// is too little to look at.
    pub fn of(residuals: &[&[f64]], period_s: f64, criteria: &RowCriteria) -> Option<Self> {
        let length = (criteria.noise_piece_s / period_s).round() as usize;
        let pieces: Vec<Vec<f64>> =
            residuals.iter().flat_map(|residual| powers(residual, length, period_s)).collect();
        if pieces.len() < criteria.fewest_noise_pieces {
            return None;
        }
        let step_hz = 1.0 / (length as f64 * period_s);
        let first = (criteria.lowest_noise_hz / step_hz).ceil() as usize;
        let last = (criteria.highest_noise_part / (period_s * step_hz)) as usize;
        let quiet: Vec<(f64, f64)> =
            (first..=last).map(|bin| (bin as f64 * step_hz, quiet_power(&pieces, bin))).collect();
        Self::fitted(&quiet, criteria)
    }

    /// The noise, its growing part no smaller than this.
    fn growing_at_least(self, growing: f64) -> Self {
        Self { growing: self.growing.max(growing), ..self }
    }

    /// The same noise where samples are `longer` times as far apart.
    fn at_another_rate(self, longer: f64) -> Self {
        Self { white: longer * self.white, growing: longer * self.growing }
    }

    /// Power density at a frequency [V^2/Hz].
    pub fn density(&self, frequency_hz: f64) -> f64 {
        self.white + self.growing * frequency_hz.powi(4)
    }

    /// Where the two parts are equal [Hz].
    pub fn corner_hz(&self) -> f64 {
        (self.white / self.growing.max(1e-300)).powf(0.25)
    }

    /// What is left of it behind a filter, rms [V].
    pub fn behind(&self, gain: impl Fn(f64) -> f64, period_s: f64) -> f64 {
        const PARTS: usize = 400;
        let step_hz = 0.5 / period_s / PARTS as f64;
        let power = |k: usize| {
            let frequency_hz = (k as f64 + 0.5) * step_hz;
            self.density(frequency_hz) * gain(frequency_hz).powi(2) * step_hz
        };
        (0..PARTS).map(power).sum::<f64>().sqrt()
    }

    /// Least squares of the relative deviation, weights from the fit before. Frequencies far
    /// above that fit are left out: a hum is no noise.
    fn fitted(quiet: &[(f64, f64)], criteria: &RowCriteria) -> Option<Self> {
        let mut noise = Self { white: quiet.iter().map(|q| q.1).sum::<f64>(), growing: 0.0 };
        for _ in 0..12 {
            let mut sums = [0.0; 5];
            let is_noise = |q: &&(f64, f64)| q.1 < criteria.hum_ratio * noise.density(q.0);
            for &(frequency_hz, power) in quiet.iter().filter(is_noise) {
                let w = noise.density(frequency_hz).max(1e-300).powi(-2);
                let f4 = frequency_hz.powi(4);
                let terms = [w, w * f4, w * f4 * f4, w * power, w * f4 * power];
                sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
            }
            let [aa, ab, bb, ay, by] = sums;
            let determinant = aa * bb - ab * ab;
            noise.growing = ((aa * by - ab * ay) / determinant).max(0.0);
            noise.white = (ay - ab * noise.growing) / aa;
            if noise.white <= 0.0 {
                let white = 1e-3 * by / bb * criteria.lowest_noise_hz.powi(4);
                noise = Self { white, growing: by / bb };
            }
        }
        (noise.white.is_finite() && noise.white > 0.0).then_some(noise)
    }
}

/// Power densities of the pieces of a signal, half overlapping, Hann-windowed.
fn powers(signal: &[f64], length: usize, period_s: f64) -> Vec<Vec<f64>> {
    if length < 8 || signal.len() < length {
        return Vec::new();
    }
    let transform = RealFftPlanner::<f64>::new().plan_fft_forward(length);
    let window: Vec<f64> =
        (0..length).map(|k| (PI * (k as f64 + 0.5) / length as f64).sin().powi(2)).collect();
    let unit = 2.0 * period_s / window.iter().map(|w| w * w).sum::<f64>();
    let piece = |start: usize| {
        let samples = &signal[start..start + length];
        let mean = samples.iter().sum::<f64>() / length as f64;
        let mut input: Vec<f64> =
            samples.iter().zip(&window).map(|(x, w)| (x - mean) * w).collect();
        let mut output = transform.make_output_vec();
        let done = transform.process(&mut input, &mut output);
        done.map(|()| output.iter().map(|c| unit * c.norm_sqr()).collect()).unwrap_or_default()
    };
    (0..=signal.len() - length).step_by(length / 2).map(piece).collect()
}

/// Mean power of noise whose lowest quarter this is: powers of noise are exponentially
/// distributed, a quarter of them lies below 0.288 of the mean.
fn quiet_power(pieces: &[Vec<f64>], bin: usize) -> f64 {
    let mut powers: Vec<f64> = pieces.iter().map(|piece| piece[bin]).collect();
    let quarter = powers.len() / 4;
    let (_, value, _) = powers.select_nth_unstable_by(quarter, f64::total_cmp);
    *value / -(0.75f64).ln()
}

/// Density of what encoder steps become once differentiated twice, per Hz^4 and per
/// (V s^2/rad)^2 of inertia.
pub fn of_encoder(step_rad: f64, period_s: f64) -> f64 {
    of_white_angles(step_rad * step_rad / 12.0, period_s)
}

/// The same of errors of the angle that are white, of this mean square [rad^2].
pub fn of_white_angles(square_rad2: f64, period_s: f64) -> f64 {
    square_rad2 * 2.0 * period_s * TAU.powi(4)
}

#[cfg(test)]
mod tests {
    use rand_distr::{Distribution, StandardNormal};
    use rand_pcg::Pcg64Mcg;

    use super::*;

    #[test]
    fn a_hum_is_no_noise() {
        let mut random = Pcg64Mcg::new(3);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let hum = |k: i32| 0.05 * (TAU * 0.04 * f64::from(k)).sin();
        let signal: Vec<f64> = (0..20_000).map(|k| 4e-3 * normal() + hum(k)).collect();
        let noise = Noise::of(&[&signal], 1e-3, &RowCriteria::default()).unwrap();
        let white = 2.0 * 1e-3 * 4e-3f64.powi(2);
        assert!((noise.density(40.0) / white - 1.0).abs() < 0.4, "{}", noise.density(40.0) / white);
    }

    #[test]
    fn noise_is_found_beside_bursts_of_motion() {
        let mut random = Pcg64Mcg::new(7);
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let angle: Vec<f64> = (0..20_002).map(|_| 2.8e-6 * normal()).collect();
        let signal: Vec<f64> = (1..=20_000)
            .map(|k| {
                let acceleration = (angle[k + 1] + angle[k - 1] - 2.0 * angle[k]) * 1e6;
                let burst = if k % 2000 < 600 { 0.1 * (0.05 * k as f64).sin() } else { 0.0 };
                4e-3 * normal() + 0.1 * acceleration + burst
            })
            .collect();
        let noise = Noise::of(&[&signal], 1e-3, &RowCriteria::default()).unwrap();
        let white = 2.0 * 1e-3 * 4e-3f64.powi(2);
        let growing = 0.01 * of_encoder(2.8e-6 * 12f64.sqrt(), 1e-3);
        // Half of all pieces hold a burst, so the quietest quarter of all is the quieter half
        // of those that hold none: powers come out twice as large.
        for (found, truth) in [(noise.white, white), (noise.growing, growing)] {
            assert!((0.8..2.6).contains(&(found / truth)), "{}", found / truth);
        }
        assert!((17.0..25.0).contains(&noise.corner_hz()), "{}", noise.corner_hz());
    }
}
