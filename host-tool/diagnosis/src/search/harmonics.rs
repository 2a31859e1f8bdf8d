//! Which harmonics of the angle an effect may have.
//!
//! Every harmonic is tried with sine and cosine, everything open refitted. To be quick, the
//! filter, and what second differences feel of a wave, are taken as their gains at the momentary frequency of the
//! harmonic, row by row.

use model::FrictionState;
use rayon::prelude::*;

use crate::criteria::SearchCriteria;
use crate::fit::linearisation::Linearisation;
use crate::logs::stretch::Stretch;
use crate::rows::evidence::{Evidence, RowChange};
use rig::Plant;
use rig::effects::{Carrier, felt_by_second_differences};

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
    let rows = JointRows::of(evidence, linear, joint, carrier);
    let mut found: Vec<Harmonic> = (1..=evidence.criteria.search.highest_harmonic)
        .into_par_iter()
        .filter_map(|order| rows.harmonic(linear, joint, order as f64))
        .collect();
    found.sort_by(|a, b| b.gain.total_cmp(&a.gain));
    found.truncate(evidence.criteria.search.harmonics);
    let effort = &evidence.criteria.search;
    let between = found.first().and_then(|best| rows.between_orders(linear, joint, best, effort));
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
    JointRows::of(evidence, linear, joint, carrier).harmonic(linear, joint, order)
}

impl Harmonic {
    /// The values of a wave's parameters.
    pub fn values(&self) -> Vec<f64> {
        vec![self.amplitude, self.order, self.phase_rad]
    }
}

/// A joint's rows as the search needs them.
struct JointRows {
    q_rad: Vec<f64>,
    speed_rad_per_s: Vec<f64>,
    /// The carrier, filtered and in units of noise.
    carrier: Vec<f64>,
    /// Gain of rows by order times speed, in steps of one Hz, by stretch.
    gains: Vec<Vec<f64>>,
    ranges: Vec<std::ops::Range<usize>>,
    train: usize,
}

impl JointRows {
    fn of(evidence: &Evidence, linear: &Linearisation, joint: usize, carrier: Carrier) -> Self {
        // Magnets and windings are in the motor, what rubs is at the joint.
        let turns = match carrier {
            Carrier::Unity | Carrier::Command => linear.hypothesis.plant.gears[joint].motor,
            Carrier::Friction => 1.0,
        };
        let mut rows = Self {
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

    /// The wave between two whole orders, next to the best of these, that gains enough more than that
    /// (`least_between_orders`); none where none does. What gains most is sought in tenths of an order, then in hundredths.
    fn between_orders(
        &self,
        linear: &Linearisation,
        joint: usize,
        whole: &Harmonic,
        effort: &SearchCriteria,
    ) -> Option<Harmonic> {
        let orders = 1.0..=effort.highest_harmonic as f64;
        let mut best = *whole;
        for step in [0.1, 0.01] {
            let middle = best.order;
            let around = (-9..=9).map(|k| middle + step * f64::from(k));
            let is_between = |order: &f64| {
                orders.contains(order) && (order - order.round()).abs() > NEARLY_WHOLE
            };
            let tried: Vec<f64> = around.filter(is_between).collect();
            let found =
                tried.into_par_iter().filter_map(|order| self.harmonic(linear, joint, order));
            best = found
                .max_by(|a, b| a.gain.total_cmp(&b.gain))
                .filter(|f| f.gain > best.gain)
                .unwrap_or(best);
        }
        (best.gain > whole.gain + effort.least_between_orders).then_some(best)
    }

    fn harmonic(&self, linear: &Linearisation, joint: usize, order: f64) -> Option<Harmonic> {
        let (sine, cosine) = self.columns(order);
        let as_change = |column: Vec<f64>| {
            let mut change: RowChange = vec![None; joint + 1];
            change[joint] = Some(column);
            change
        };
        let slopes = [as_change(sine), as_change(cosine)];
        let (gradient, curvature) = linear.along(&RowChange::default(), &slopes);
        let trace = curvature.trace();
        let solution = -curvature.clone().lu().solve(&gradient)?;
        let useful = curvature.determinant() > 1e-6 * trace * trace && trace > 1.0;
        useful.then(|| Harmonic {
            order,
            amplitude: solution.norm(),
            phase_rad: solution[1].atan2(solution[0]),
            gain: -solution.dot(&gradient),
        })
    }

    /// Rows of the carrier times sine and cosine of the harmonic.
    fn columns(&self, order: f64) -> (Vec<f64>, Vec<f64>) {
        let mut sine = vec![0.0; self.q_rad.len()];
        let mut cosine = sine.clone();
        for (range, gains) in self.ranges.iter().zip(&self.gains) {
            if range.start >= self.train {
                break;
            }
            for k in range.clone() {
                let frequency_hz = order * self.speed_rad_per_s[k] / std::f64::consts::TAU;
                let gain = gains.get(frequency_hz as usize).copied().unwrap_or(0.0);
                let (s, c) = (order * self.q_rad[k]).sin_cos();
                sine[k] = self.carrier[k] * gain * s;
                cosine[k] = self.carrier[k] * gain * c;
            }
        }
        (sine, cosine)
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
