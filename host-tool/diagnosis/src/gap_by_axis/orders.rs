//! Orders per revolution: how much of a residual repeats n times a turn.

use super::angle::{AngleSums, Carrier};
use super::samples::Samples;
use super::shape::centred;

/// Highest order that [`orders`] gives.
const HIGHEST_SHOWN: usize = 60;

/// Amplitudes over a turn, by order from 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Orders {
    /// What the sine is multiplied by.
    pub carrier: Carrier,
    /// Amplitude of each order [V], at the rms of the carrier; none below the lowest order that
    /// the range of the angle shows.
    pub amplitude_v: Vec<Option<f64>>,
}

/// The lowest order that goes through enough periods in the range of the angle.
pub fn lowest_order(samples: &Samples) -> usize {
    let angles = || samples.position_rad.iter().copied();
    let range = angles().fold(f64::NEG_INFINITY, f64::max) - angles().fold(f64::INFINITY, f64::min);
    let lowest = samples.criteria.least_periods * std::f64::consts::TAU / range.max(1e-9);
    (lowest.ceil() as usize).max(1)
}

/// Amplitudes of all orders with one carrier.
pub fn orders(samples: &Samples, carrier: Carrier) -> Orders {
    let sums = AngleSums::of(samples, &centred(&samples.residual_v));
    let lowest = lowest_order(samples);
    let amplitude = |order: usize| (order >= lowest).then(|| sums.wave(order, carrier).amplitude_v);
    Orders { carrier, amplitude_v: (0..=HIGHEST_SHOWN).map(amplitude).collect() }
}

/// The carrier whose largest order takes most off the residual; none, unless one is clearly better.
pub fn best_carrier(samples: &Samples) -> Carrier {
    let sums = AngleSums::of(samples, &centred(&samples.residual_v));
    let lowest = lowest_order(samples);
    let best = |carrier: Carrier| {
        let waves = (lowest..=samples.criteria.highest_order)
            .map(|order| sums.wave(order, carrier).energy_v2);
        waves.fold(0.0, f64::max)
    };
    let least_v2 = samples.criteria.carrier_ratio * best(Carrier::Constant);
    let others = [Carrier::Direction, Carrier::Command].map(|carrier| (carrier, best(carrier)));
    let better = others.into_iter().filter(|other| other.1 > least_v2);
    let best = better.max_by(|a, b| a.1.total_cmp(&b.1));
    best.map_or(Carrier::Constant, |best| best.0)
}
