//! Band-limited noise, repeatable by its seed.

use serde::{Deserialize, Serialize};

/// Noise of a given root mean square, low-passed by a Butterworth filter of fourth order.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Noise {
    /// Root mean square [V].
    pub rms_v: f32,
    /// Where it has fallen by 3 dB [Hz], below half the sample rate.
    pub bandwidth_hz: f32,
    /// Same seed, same noise.
    pub seed: u32,
}

/// Makes the noise, sample by sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseSource {
    random: XorShift,
    filter: [Biquad; 2],
    scale_v: f32,
}

impl NoiseSource {
    /// The beginning of the noise at a sample rate.
    pub fn new(noise: &Noise, rate_per_s: f32) -> Self {
        let filter = butterworth_low_pass(noise.bandwidth_hz / rate_per_s);
        let power: f32 = ImpulseResponse(filter).map(|h| h * h).sum();
        Self {
            random: XorShift::new(noise.seed),
            filter,
            scale_v: noise.rms_v / model::Real::sqrt(power),
        }
    }

    /// Whether this is such a noise, so many samples later.
    pub fn goes_on_from(&self, beginning: &Self) -> bool {
        let coefficients = |filter: &Biquad| [filter.gain, filter.a1, filter.a2];
        self.scale_v == beginning.scale_v
            && self.filter.each_ref().map(coefficients)
                == beginning.filter.each_ref().map(coefficients)
    }

    /// The next sample [V].
    #[inline]
    pub fn next_voltage(&mut self) -> f32 {
        let white = self.random.next_deviate() * self.scale_v;
        let once = self.filter[0].filter(white);
        self.filter[1].filter(once)
    }
}

/// The filter's answer to a single one; long enough for 10 Hz at 1 kHz to die out.
struct ImpulseResponse([Biquad; 2]);

impl ImpulseResponse {
    fn map<T>(mut self, f: impl Fn(f32) -> T) -> impl Iterator<Item = T> {
        (0..1000).map(move |k| {
            let once = self.0[0].filter(if k == 0 { 1.0 } else { 0.0 });
            f(self.0[1].filter(once))
        })
    }
}

/// A second-order section, transposed direct form 2.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Biquad {
    gain: f32,
    a1: f32,
    a2: f32,
    state: [f32; 2],
}

impl Biquad {
    /// Zeros are both at half the sample rate, so b = gain (1, 2, 1).
    #[inline]
    fn filter(&mut self, input: f32) -> f32 {
        let scaled = self.gain * input;
        let output = scaled + self.state[0];
        self.state[0] = 2.0 * scaled - self.a1 * output + self.state[1];
        self.state[1] = scaled - self.a2 * output;
        output
    }
}

/// Butterworth low-pass of fourth order by the bilinear transform; `cutoff` is a
/// fraction of the sample rate, below one half.
fn butterworth_low_pass(cutoff: f32) -> [Biquad; 2] {
    let (sine, cosine) = model::Real::sin_cos(core::f32::consts::PI * cutoff);
    let warped = sine / cosine;
    // 2 cos of the pole angles, pi/8 and 3 pi/8.
    [1.847_759_1, 0.765_366_9].map(|damping| {
        let square = warped * warped;
        let scale = 1.0 / (1.0 + damping * warped + square);
        Biquad {
            gain: square * scale,
            a1: 2.0 * (square - 1.0) * scale,
            a2: (1.0 - damping * warped + square) * scale,
            state: [0.0; 2],
        }
    })
}

/// Marsaglia's xorshift with 32 bits.
#[derive(Clone, Copy, Debug, PartialEq)]
struct XorShift(u32);

impl XorShift {
    fn new(seed: u32) -> Self {
        // Zero would stay zero.
        Self(seed.wrapping_mul(0x9E37_79B9) ^ 0x85EB_CA6B | 1)
    }

    #[inline]
    fn next(&mut self) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        self.0
    }

    /// A nearly normal deviate of variance one: the sum of four uniform ones, so
    /// never beyond 3.5 and never out of the pre-sliding range by a wild sample.
    #[inline]
    fn next_deviate(&mut self) -> f32 {
        let [a, b] = [self.next(), self.next()];
        let halves = |x: u32| i32::from(x as u16 as i16) + i32::from((x >> 16) as u16 as i16);
        // Four uniforms of variance 2^32 / 12 each; with the half step of each.
        (halves(a) + halves(b) + 2) as f32 * (1.732_050_8 / 65_536.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(seed: u32) -> Vec<f32> {
        let noise = Noise { rms_v: 0.0025, bandwidth_hz: 200.0, seed };
        let mut source = NoiseSource::new(&noise, 1000.0);
        (0..200_000).map(|_| source.next_voltage()).collect()
    }

    #[test]
    fn rms_and_mean_are_as_asked() {
        for seed in 0..5 {
            let noise = samples(seed);
            let mean = noise.iter().sum::<f32>() / noise.len() as f32;
            let power = noise.iter().map(|v| v * v).sum::<f32>() / noise.len() as f32;
            assert!((power.sqrt() / 0.0025 - 1.0).abs() < 0.02, "{}", power.sqrt());
            assert!(mean.abs() < 5e-5, "{mean}");
        }
    }

    #[test]
    fn the_band_ends_at_200_hz() {
        let noise = samples(1);
        let power_at = |hz: f32| {
            let turn = std::f32::consts::TAU * hz / 1000.0;
            noise
                .chunks(1000)
                .map(|block| {
                    let sum = block.iter().enumerate().fold((0.0, 0.0), |(re, im), (k, v)| {
                        let (s, c) = (turn * k as f32).sin_cos();
                        (re + v * c, im + v * s)
                    });
                    sum.0 * sum.0 + sum.1 * sum.1
                })
                .sum::<f32>()
        };
        let low: f32 = (20..60).step_by(4).map(|hz| power_at(hz as f32)).sum();
        let edge: f32 = (196..206).map(|hz| power_at(hz as f32)).sum();
        let high: f32 = (380..420).step_by(4).map(|hz| power_at(hz as f32)).sum();
        assert!((0.35..0.65).contains(&(edge / low)), "half the power at the edge: {}", edge / low);
        assert!(high < 0.002 * low, "{}", high / low);
    }

    #[test]
    fn the_seed_decides() {
        assert_eq!(samples(7), samples(7));
        assert_ne!(samples(7)[..100], samples(8)[..100]);
    }
}
