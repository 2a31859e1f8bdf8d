//! The band in which a log can speak, from its rate and the noise of its positions.

use signal::{LowPass, derivative, rms};

use super::noise::{derivative_noise, position_noise};
use super::settings::Settings;
use super::stretch::Stretch;

/// The low-passes of a log, and what noise they leave.
#[derive(Clone, Debug, PartialEq)]
pub struct Band {
    /// Cut-off of positions and commands [Hz].
    pub cutoff_hz: f64,
    /// Cut-off that regressor and command pass afterwards [Hz].
    pub second_hz: f64,
    /// Velocity below which each joint stands [rad/s; m/s].
    pub standstill: Vec<f64>,
}

impl Band {
    /// Of the stretches of a log (at least one); `encoder_steps` per joint [rad; m] where known.
    pub fn of(stretches: &[Stretch], encoder_steps: &[Option<f64>], settings: &Settings) -> Self {
        let longest = stretches.iter().max_by_key(|stretch| stretch.len());
        let longest = longest.expect("a log has a stretch");
        let noise: Vec<f64> = (longest.position.iter().zip(encoder_steps))
            .map(|(position, step)| position_noise(position, *step))
            .collect();
        let cutoffs = longest.position.iter().zip(&noise);
        let cutoffs =
            cutoffs.map(|(position, noise)| cutoff(position, *noise, longest.period_s, settings));
        let cutoff_hz = cutoffs.fold(highest(longest.period_s, settings), f64::min);
        let stands = longest.position.iter().zip(&noise).map(|(position, noise)| {
            let velocity = speed(position, cutoff_hz, longest.period_s);
            let [left, _] = derivative_noise(*noise, cutoff_hz, longest.period_s);
            (settings.standstill * velocity).max(settings.standstill_noise * left)
        });
        Self {
            standstill: stands.collect(),
            second_hz: settings.second_cutoff * cutoff_hz,
            cutoff_hz,
        }
    }

    /// Shortest stretch that can be used [s].
    pub fn shortest_s(&self, settings: &Settings) -> f64 {
        settings.shortest / self.second_hz
    }
}

/// Highest cut-off at a sampling period [Hz].
fn highest(period_s: f64, settings: &Settings) -> f64 {
    settings.highest_cutoff_hz.min(settings.cutoff_by_rate / period_s)
}

/// The highest cut-off at which noise is a small part of a joint's acceleration [Hz]; a joint
/// that does not move sets none.
fn cutoff(position: &[f64], noise: f64, period_s: f64, settings: &Settings) -> f64 {
    /// Ratio of one cut-off to the next that is tried.
    const RATIO: f64 = 0.84;
    let (highest, lowest) = (highest(period_s, settings), settings.lowest_cutoff_hz);
    let mut cutoff_hz = highest;
    while cutoff_hz > lowest {
        let smooth = LowPass::new(cutoff_hz, period_s).zero_phase(position);
        let all = rms(&derivative::second(&smooth, period_s));
        let [_, noise] = derivative_noise(noise, cutoff_hz, period_s);
        let motion = (all * all - noise * noise).max(0.0).sqrt();
        if noise <= settings.acceleration_noise * motion {
            return cutoff_hz;
        }
        cutoff_hz *= RATIO;
    }
    // Even slowly it is noise alone: the joint stands.
    highest
}

fn speed(position: &[f64], cutoff_hz: f64, period_s: f64) -> f64 {
    let smooth = LowPass::new(cutoff_hz, period_s).zero_phase(position);
    rms(&derivative::first(&smooth, period_s))
}
