//! Which harmonics of the angle an effect may have.
//!
//! Every harmonic is tried with sine and cosine, everything open refitted.

use rayon::prelude::*;

use super::wave_rows::{Orders, WaveRows};
use crate::criteria::SearchCriteria;
use crate::fit::linearisation::Linearisation;
use crate::fit::pairs::AlongPair;
use crate::rows::evidence::Evidence;
use rig::effects::Carrier;

/// An order this close to a whole one is that: magnets, teeth and windings are whole, and what is left of other waves
/// draws an order a little to one side.
const NEARLY_WHOLE: f64 = 0.2;

/// A harmonic with the amplitude and the phase that suit it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Harmonic {
    /// Per turn; seldom a whole number behind gears, belts and bearings.
    pub order: f64,
    /// Amplitude in units of the carrier.
    pub amplitude: f64,
    /// Phase of its sine [rad].
    pub phase_rad: f64,
    /// What it takes off the train score.
    pub gain: f64,
}

/// The harmonics of a joint's angle that gain most with this carrier, the best first.
pub fn best(
    linear: &Linearisation,
    evidence: &Evidence,
    joint: usize,
    carrier: Carrier,
) -> Vec<Harmonic> {
    let effort = &evidence.criteria.search;
    let rows = WaveRows::of(evidence, linear, joint, carrier);
    let whole = Orders::whole_up_to(effort.highest_harmonic);
    let mut found: Vec<Harmonic> =
        whole.into_par_iter().flat_map_iter(|orders| harmonics(linear, &rows, orders)).collect();
    found.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    found.truncate(effort.harmonics);
    let between = found.first().and_then(|best| between_orders(linear, &rows, best, effort));
    between.into_iter().chain(found).collect()
}

/// A harmonic of a joint's angle with the amplitude and the phase that suit it; none where the logs do not tell them.
pub fn of_order(
    linear: &Linearisation,
    evidence: &Evidence,
    joint: usize,
    carrier: Carrier,
    order: f64,
) -> Option<Harmonic> {
    let rows = WaveRows::of(evidence, linear, joint, carrier);
    harmonics(linear, &rows, Orders::just(order)).into_iter().next()
}

impl Harmonic {
    /// The one along whose sine and cosine the score has this slope and curvature.
    fn of(order: f64, along: &AlongPair) -> Option<Self> {
        let AlongPair { gradient, curvature } = along;
        let trace = curvature.trace();
        let useful = curvature.determinant() > 1e-6 * trace * trace && trace > 1.0;
        let solution = -curvature.lu().solve(gradient)?;
        useful.then(|| Self {
            order,
            amplitude: solution.norm(),
            phase_rad: solution[1].atan2(solution[0]),
            gain: -solution.dot(gradient),
        })
    }

    /// The values of a wave's parameters.
    pub fn values(&self) -> Vec<f64> {
        vec![self.amplitude, self.order, self.phase_rad]
    }
}

/// The wave between two whole orders, next to the best of these, that gains enough more than that
/// (`least_between_orders`), of those of which enough periods were passed (`least_periods_of_fractional_order`); none where
/// none does. What gains most is sought in tenths of an order, then in hundredths.
fn between_orders(
    linear: &Linearisation,
    rows: &WaveRows,
    whole: &Harmonic,
    effort: &SearchCriteria,
) -> Option<Harmonic> {
    let least = rows.order_passed(effort.least_periods_of_fractional_order).max(1.0);
    let orders = least..=effort.highest_harmonic as f64;
    let is_between = |found: &Harmonic| {
        orders.contains(&found.order) && (found.order - found.order.round()).abs() > NEARLY_WHOLE
    };
    let mut best = *whole;
    for step in [0.1, 0.01] {
        let around = harmonics(linear, rows, Orders::around(best.order, step, 9));
        let found = around.into_iter().filter(is_between).max_by(|a, b| a.gain.total_cmp(&b.gain));
        best = found.filter(|found| found.gain > best.gain).unwrap_or(best);
    }
    (best.gain > whole.gain + effort.least_between_orders).then_some(best)
}

/// The harmonics of these orders that the logs tell.
fn harmonics(linear: &Linearisation, rows: &WaveRows, orders: Orders) -> Vec<Harmonic> {
    let pairs = linear.along_pairs(rows.joint, &rows.columns(&orders));
    let of = |(order, pair): (f64, AlongPair)| Harmonic::of(order, &pair);
    orders.each().into_iter().zip(pairs).filter_map(of).collect()
}
