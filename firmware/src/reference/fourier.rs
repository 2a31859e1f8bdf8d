//! The five-term Fourier series that excites all parameters, section 4.2.

use serde::{Deserialize, Serialize};

use super::setpoint::Setpoint;
use super::time::Time;
use super::wave::{FadeIn, Wave, sin_cos_of_cycle};

/// Terms of the series.
pub const TERMS: usize = 5;

/// q = centre + sum over k = 1..5 of `sine_k` sin(k w t) + `cosine_k` cos(k w t), w = 2 pi / period.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FourierSeries {
    /// Centre [rad].
    pub centre_rad: f32,
    /// Period of the first term [s], rounded to a whole number of ticks.
    pub period_s: f32,
    /// Sine amplitudes [rad].
    pub sine_rad: [f32; TERMS],
    /// Cosine amplitudes [rad].
    pub cosine_rad: [f32; TERMS],
    /// Its fade-in.
    pub fade_in: FadeIn,
}

impl FourierSeries {
    /// The setpoint in the middle of a tick's interval.
    #[inline]
    pub(super) fn at(&self, time: Time) -> Setpoint {
        let wave = self.sum(time.fraction_of_cycle(self.period_s));
        self.fade_in.apply(wave, time).about(self.centre_rad)
    }

    /// The series at a fraction of its period; higher terms by the angle-addition
    /// formulas from the first, which is wrong by no more than 1e-6 of the amplitude.
    #[inline]
    fn sum(&self, fraction: f32) -> Wave {
        let angular_rad_per_s = core::f32::consts::TAU / self.period_s;
        let (first_sine, first_cosine) = sin_cos_of_cycle(fraction);
        let (mut sine, mut cosine) = (0.0_f32, 1.0_f32);
        let mut wave = Wave { value: 0.0, slope: 0.0, curvature: 0.0 };
        let mut frequency = 0.0;
        for (a, b) in self.sine_rad.iter().zip(&self.cosine_rad) {
            (sine, cosine) = (
                sine * first_cosine + cosine * first_sine,
                cosine * first_cosine - sine * first_sine,
            );
            frequency += angular_rad_per_s;
            let value = a * sine + b * cosine;
            wave.value += value;
            wave.slope += frequency * (a * cosine - b * sine);
            wave.curvature -= frequency * frequency * value;
        }
        wave
    }
}
