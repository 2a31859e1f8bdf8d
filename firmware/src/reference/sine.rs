//! The sine of the validation motion, eq. (20)-(21).

use serde::{Deserialize, Serialize};

use super::setpoint::Setpoint;
use super::time::Time;
use super::wave::{FadeIn, Wave, sin_cos_of_cycle};

/// q = centre + amplitude sin(2 pi t / period), the sine of eq. (20), with a fade-in.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sine {
    /// Centre, the start position q_ref(0) of eq. (21) [rad].
    pub centre_rad: f32,
    /// Amplitude [rad].
    pub amplitude_rad: f32,
    /// Period [s], rounded to a whole number of ticks.
    pub period_s: f32,
    /// Its fade-in.
    pub fade_in: FadeIn,
}

impl Sine {
    #[inline]
    pub(super) fn at(&self, time: Time) -> Setpoint {
        let angular_rad_per_s = core::f32::consts::TAU / self.period_s;
        let (sine, cosine) = sin_cos_of_cycle(time.fraction_of_cycle(self.period_s));
        let wave = Wave {
            value: self.amplitude_rad * sine,
            slope: self.amplitude_rad * angular_rad_per_s * cosine,
            curvature: -self.amplitude_rad * angular_rad_per_s * angular_rad_per_s * sine,
        };
        self.fade_in.apply(wave, time).about(self.centre_rad)
    }
}
