//! Rows of waves over a joint's turn: a carrier times sine and cosine of so many turns of its angle.
//!
//! To be quick, the filter, and what second differences feel of a wave, are taken as their gains at the momentary
//! frequency of the wave, row by row.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;

use model::FrictionState;
use nalgebra::DMatrix;

use crate::fit::linearisation::Linearisation;
use crate::logs::stretch::Stretch;
use crate::rows::evidence::Evidence;
use rig::Plant;
use rig::effects::{Carrier, felt_by_second_differences};

/// Orders at even distances from one of them.
#[derive(Clone, Debug)]
pub(super) struct Orders {
    middle: f64,
    step: f64,
    /// How many steps away they are.
    steps: RangeInclusive<i32>,
}

/// How many whole orders are tried at a time.
const AT_A_TIME: usize = 10;

impl Orders {
    /// One alone.
    pub fn just(order: f64) -> Self {
        Self { middle: order, step: 0.0, steps: 0..=0 }
    }

    /// All whole ones from 1 on, some at a time.
    pub fn whole_up_to(highest: usize) -> Vec<Self> {
        let from = |first: usize| {
            let last = (first + AT_A_TIME - 1).min(highest);
            Self { middle: 0.0, step: 1.0, steps: first as i32..=last as i32 }
        };
        (1..=highest).step_by(AT_A_TIME).map(from).collect()
    }

    /// So many on either side of one, and that itself.
    pub fn around(middle: f64, step: f64, each_side: i32) -> Self {
        Self { middle, step, steps: -each_side..=each_side }
    }

    /// They themselves.
    pub fn each(&self) -> Vec<f64> {
        self.steps.clone().map(|steps| self.middle + self.step * f64::from(steps)).collect()
    }
}

/// A joint's rows as waves over its turn need them.
pub(super) struct WaveRows {
    /// The joint, from 0.
    pub joint: usize,
    q_rad: Vec<f64>,
    speed_rad_per_s: Vec<f64>,
    /// The carrier, filtered and in units of noise.
    carrier: Vec<f64>,
    /// Gain of rows by order times speed, in steps of one Hz, by stretch.
    gains: Vec<Vec<f64>>,
    ranges: Vec<std::ops::Range<usize>>,
    train: usize,
}

impl WaveRows {
    /// The order of which a shaft passes so many periods in the logs.
    pub fn order_passed(&self, periods: f64) -> f64 {
        let lowest = self.q_rad.iter().copied().fold(f64::INFINITY, f64::min);
        let highest = self.q_rad.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        periods * TAU / (highest - lowest)
    }

    /// Those of a carrier's waves on a joint (from 0).
    pub fn of(evidence: &Evidence, linear: &Linearisation, joint: usize, carrier: Carrier) -> Self {
        // Magnets and windings are in the motor, what rubs is at the joint.
        let turns = match carrier {
            Carrier::Unity | Carrier::Command => linear.hypothesis.plant.gears[joint].motor,
            Carrier::Friction => 1.0,
        };
        let mut rows = Self {
            joint,
            q_rad: Vec::new(),
            speed_rad_per_s: Vec::new(),
            carrier: Vec::new(),
            gains: Vec::new(),
            ranges: evidence.ranges(joint),
            train: linear.train_rows(joint),
        };
        // What adds to a motor's volts, or to its friction, counts in volts as sent; the command is sent itself.
        let gain = match carrier {
            Carrier::Command => 1.0,
            Carrier::Unity | Carrier::Friction => linear.hypothesis.motor_gain(joint),
        };
        for (s, stretch) in evidence.stretches.iter().enumerate() {
            let filter = evidence.filter(joint, s);
            for k in filter.instants(stretch.len()) {
                rows.q_rad.push(turns * stretch.motion.q_rad[joint][k]);
                rows.speed_rad_per_s.push((turns * stretch.motion.qd_rad_per_s[joint][k]).abs());
            }
            let signal = match carrier {
                Carrier::Unity => vec![1.0; stretch.len()],
                Carrier::Command => stretch.command_v[joint].clone(),
                Carrier::Friction => friction_level(&linear.hypothesis.plant, joint, stretch),
            };
            let as_sent: Vec<f64> = signal.iter().map(|carrier| carrier / gain).collect();
            rows.carrier.extend(evidence.weighted(s, joint, &as_sent));
            let nyquist_hz = (0.5 / stretch.period_s) as usize;
            let gain = |f: usize| {
                let half = std::f64::consts::PI * f as f64 * stretch.period_s;
                filter.gain(f as f64) * felt_by_second_differences(half)
            };
            rows.gains.push((0..=nyquist_hz).map(gain).collect());
        }
        rows
    }

    /// Rows of the train logs: of each order the carrier times sine and times cosine, column by column (rows by twice the
    /// orders). Only the first order's angle is computed, the others are turned on from it, to 1e-12.
    pub fn columns(&self, orders: &Orders) -> DMatrix<f64> {
        let each = orders.each();
        let mut columns = DMatrix::zeros(self.train, 2 * each.len());
        for (range, gains) in self.ranges.iter().zip(&self.gains) {
            for k in range.start..range.end.min(self.train) {
                let (mut sine, mut cosine) = (each[0] * self.q_rad[k]).sin_cos();
                let (turn_sine, turn_cosine) = (orders.step * self.q_rad[k]).sin_cos();
                for (place, order) in each.iter().enumerate() {
                    let frequency_hz = order * self.speed_rad_per_s[k] / std::f64::consts::TAU;
                    let gain = gains.get(frequency_hz as usize).copied().unwrap_or(0.0);
                    columns[(k, 2 * place)] = self.carrier[k] * gain * sine;
                    columns[(k, 2 * place + 1)] = self.carrier[k] * gain * cosine;
                    (sine, cosine) = (
                        sine * turn_cosine + cosine * turn_sine,
                        cosine * turn_cosine - sine * turn_sine,
                    );
                }
            }
        }
        columns
    }
}

/// Friction without its viscous part, as it adds to the net voltage.
fn friction_level(plant: &Plant, joint: usize, stretch: &Stretch) -> Vec<f64> {
    let friction = model::Friction { alpha2_v_s_per_rad: 0.0, ..plant.friction[joint] };
    let period_s = stretch.period_s;
    let v = stretch.motion.sliding_velocity(joint, stretch.at_rest_rad[joint], period_s);
    let mut bend = FrictionState::default();
    v.iter().map(|&v| -bend.step(&friction, v, period_s)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half a thousand samples of a shaft that swings by six radians.
    fn swinging() -> WaveRows {
        let q_rad: Vec<f64> = (0..500).map(|k| 3.0 * (0.05 * f64::from(k)).sin()).collect();
        WaveRows {
            joint: 0,
            speed_rad_per_s: vec![0.0; q_rad.len()],
            carrier: (0..500).map(|k| 1.0 + 0.01 * f64::from(k)).collect(),
            gains: vec![vec![0.5]],
            ranges: std::iter::once(0..q_rad.len()).collect(),
            train: 450,
            q_rad,
        }
    }

    #[test]
    fn an_order_is_passed_by_the_swing_of_its_shaft() {
        let order = swinging().order_passed(2.0);
        assert!((order * 6.0 / TAU - 2.0).abs() < 1e-3, "{order}");
    }

    #[test]
    fn waves_turned_on_from_order_to_order_are_those_of_their_order() {
        let rows = swinging();
        let last = Orders::whole_up_to(97).pop().unwrap();
        for orders in [last, Orders::around(39.8, 0.01, 9), Orders::just(7.0)] {
            let columns = rows.columns(&orders);
            assert_eq!(columns.shape(), (450, 2 * orders.each().len()));
            for (place, order) in orders.each().into_iter().enumerate() {
                for k in 0..450 {
                    let (sine, cosine) = (order * rows.q_rad[k]).sin_cos();
                    let size = 0.5 * rows.carrier[k];
                    let error = (columns[(k, 2 * place)] - size * sine).abs()
                        + (columns[(k, 2 * place + 1)] - size * cosine).abs();
                    assert!(error < 1e-12, "order {order}: {error}");
                }
            }
        }
    }

    #[test]
    fn all_whole_orders_are_tried_once() {
        let all: Vec<f64> = Orders::whole_up_to(23).iter().flat_map(Orders::each).collect();
        assert_eq!(all, (1..=23).map(f64::from).collect::<Vec<f64>>());
    }
}
