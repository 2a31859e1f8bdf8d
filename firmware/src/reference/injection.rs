//! Voltages added to the command: open-loop excitation.

use serde::{Deserialize, Serialize};

use super::noise::{Noise, NoiseSource};
use super::time::Time;
use super::wave::sin_cos_of_cycle;

/// A voltage added to one joint's command.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Injection {
    /// Nothing.
    None,
    /// A slow and a fast sine of growing amplitude, as in Fig. 2 of the paper.
    FrictionExcitation(FrictionExcitation),
    /// Band-limited noise, section 3.2.
    Noise(Noise),
}

/// A slow and a fast sine whose sum grows from first to last amplitude.
///
/// The slow one carries the joint through its reversals, the fast one spreads the
/// velocities between; together they excite all parameters of the one-joint model, eq. (11).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrictionExcitation {
    /// Amplitude at the beginning [V].
    pub first_amplitude_v: f32,
    /// Amplitude after `growth_s` [V].
    pub last_amplitude_v: f32,
    /// Time of growth [s].
    pub growth_s: f32,
    /// Period of the slow sine [s].
    pub slow_period_s: f32,
    /// Period of the fast sine [s].
    pub fast_period_s: f32,
}

impl FrictionExcitation {
    #[inline]
    fn at(&self, time: Time) -> f32 {
        let elapsed = time.seconds() / self.growth_s;
        let grown = if elapsed < 1.0 { elapsed } else { 1.0 };
        let amplitude_v =
            self.first_amplitude_v + grown * (self.last_amplitude_v - self.first_amplitude_v);
        let (slow, _) = sin_cos_of_cycle(time.fraction_of_cycle(self.slow_period_s));
        let (fast, _) = sin_cos_of_cycle(time.fraction_of_cycle(self.fast_period_s));
        amplitude_v * (0.6 * slow + 0.4 * fast)
    }
}

/// The generator of an [`Injection`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InjectionSource {
    /// Nothing.
    None,
    /// A function of time.
    FrictionExcitation(FrictionExcitation),
    /// Noise with its filter's state.
    Noise(NoiseSource),
}

impl InjectionSource {
    /// The beginning of an injection.
    pub fn new(injection: &Injection, rate_per_s: f32) -> Self {
        match injection {
            Injection::None => Self::None,
            Injection::FrictionExcitation(excitation) => Self::FrictionExcitation(*excitation),
            Injection::Noise(noise) => Self::Noise(NoiseSource::new(noise, rate_per_s)),
        }
    }

    /// Whether this is such a source, so many samples later.
    pub fn goes_on_from(&self, beginning: &Self) -> bool {
        match (self, beginning) {
            (Self::Noise(source), Self::Noise(beginning)) => source.goes_on_from(beginning),
            _ => self == beginning,
        }
    }

    /// The voltage of this tick [V].
    #[inline]
    pub fn next_voltage(&mut self, time: Time) -> f32 {
        match self {
            Self::None => 0.0,
            Self::FrictionExcitation(excitation) => excitation.at(time),
            Self::Noise(source) => source.next_voltage(),
        }
    }
}
