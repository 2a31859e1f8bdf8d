//! Orders per revolution: how much of a residual repeats n times a turn.

use super::Samples;
use super::angle::{AngleSums, CARRIERS, Carrier};

/// Highest order that is looked for.
pub const HIGHEST_ORDER: usize = 100;

/// Amplitudes over a turn, by order from 0; what has no answer is NaN.
#[derive(Clone, Debug, PartialEq)]
pub struct Orders {
    /// What the sine is multiplied by.
    pub carrier: Carrier,
    /// Amplitude of each order [V], at the rms of the carrier.
    pub amplitude_v: Vec<f64>,
}

/// The lowest order that goes through one and a half periods in the range of the angle.
pub fn lowest_order(samples: &Samples) -> usize {
    let angles = || samples.position_rad.iter().copied();
    let range = angles().fold(f64::NEG_INFINITY, f64::max) - angles().fold(f64::INFINITY, f64::min);
    const PERIODS: f64 = 1.5;
    let lowest = PERIODS * std::f64::consts::TAU / range.max(1e-9);
    (lowest.ceil() as usize).max(1)
}

/// Amplitudes of all orders with one carrier.
pub fn orders(samples: &Samples, carrier: Carrier) -> Orders {
    let sums = AngleSums::of(samples, &samples.residual_v);
    let lowest = lowest_order(samples);
    let amplitude = |order: usize| {
        if order < lowest { f64::NAN } else { sums.wave(order, carrier).amplitude_v }
    };
    Orders { carrier, amplitude_v: (0..=HIGHEST_ORDER).map(amplitude).collect() }
}

/// The carrier whose largest order takes most off the residual.
pub fn best_carrier(samples: &Samples) -> Carrier {
    let sums = AngleSums::of(samples, &samples.residual_v);
    sums.best(lowest_order(samples), HIGHEST_ORDER).map_or(CARRIERS[0], |wave| wave.carrier)
}
