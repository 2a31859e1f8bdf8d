//! From the vector that is searched to a motion, and what it costs.

use firmware::reference::TERMS;
use model::Robot;

use super::condition::{condition_number, stacked_regressor};
use super::demand::Demand;
use super::series::{Series, State};
use super::settings::Settings;

/// How many numbers are searched: a sine and a cosine for each term and joint.
pub const DIMENSION: usize = 2 * TERMS * 3;

/// Samples of a period in the search. Joints turn at up to 3 pi rad/s: the fastest of
/// the regressor's harmonics, twice q2 + q3, stays below half of this rate.
const SAMPLES: usize = 250;

/// The task of design as a function to minimise.
#[derive(Clone, Copy, Debug)]
pub struct Objective<'a> {
    /// The robot that will move.
    pub robot: &'a Robot<f64>,
    /// What is asked.
    pub settings: &'a Settings,
}

impl Objective<'_> {
    /// ln J_k of the motion that a vector means, with penalties.
    ///
    /// Velocities are brought within their limits by scaling, which is exact; voltages,
    /// in which all joints meet, by a penalty that rises faster than ln J_k falls.
    pub fn cost(&self, vector: &[f64]) -> f64 {
        const HOPELESS: f64 = 1e3;
        const FOR_VOLTAGE: f64 = 5.0;
        const FOR_LENGTH: f64 = 0.01;
        let wanted = self.series(vector);
        let (series, demand) =
            self.within_limits_of_joints(&wanted, self.settings.period_s / SAMPLES as f64);
        let excess: f64 = demand
            .command_share(&self.settings.limits)
            .iter()
            .map(|share| (share - 1.0).max(0.0))
            .sum();
        // All vectors along a ray mean the same motion: the search shall not wander off.
        let length = vector.iter().map(|x| x * x).sum::<f64>() / DIMENSION as f64;
        let cost = self.condition_number(series.period(SAMPLES)).ln()
            + FOR_VOLTAGE * excess
            + FOR_LENGTH * length;
        if cost.is_finite() { cost } else { HOPELESS }
    }

    /// The best motion along a vector: within all limits, judged every `step_s`.
    pub fn motion(&self, vector: &[f64], step_s: f64) -> Series {
        let (mut series, mut demand) = self.within_limits_of_joints(&self.series(vector), step_s);
        // Slower motion needs less voltage, down to gravity and friction.
        while !demand.keeps(&self.settings.limits) {
            const SLOWER: f64 = 0.99;
            series = series.scaled([SLOWER; 3]);
            if series.is_still() {
                break;
            }
            demand = self.demand(&series, step_s);
        }
        series
    }

    /// J_k of states.
    pub fn condition_number(&self, states: impl Iterator<Item = State>) -> f64 {
        let k_t = &self.robot.torque_constant_nm_per_v;
        condition_number(&stacked_regressor(&self.robot.geometry, k_t, states))
    }

    /// The peaks of a motion, as it begins and over its period.
    pub fn demand(&self, series: &Series, step_s: f64) -> Demand {
        let count = (self.settings.period_s / step_s).round() as usize;
        Demand::of(self.robot, series.beginning(step_s).chain(series.period(count)))
    }

    /// A vector as a motion: its entries are peak velocities of single terms, as shares
    /// of the joint's limit, so that all are of the same size.
    fn series(&self, vector: &[f64]) -> Series {
        let usable = self.settings.limits.usable_velocity_rad_per_s();
        let frequency = std::f64::consts::TAU / self.settings.period_s;
        let amplitude = |joint: usize, half: usize, term: usize| {
            let share = vector.get((2 * joint + half) * TERMS + term).copied().unwrap_or(0.0);
            share * usable[joint] / (frequency * (term + 1) as f64)
        };
        let half = |half| [0, 1, 2].map(|i| [0, 1, 2, 3, 4].map(|term| amplitude(i, half, term)));
        Series {
            centre_rad: self.settings.centre_rad,
            period_s: self.settings.period_s,
            fade_in_s: self.settings.fade_in_s,
            sine_rad: half(0),
            cosine_rad: half(1),
        }
    }

    /// Whether the joints stay in their ranges, to rounding.
    pub fn stays_in_range(&self, series: &Series, step_s: f64) -> bool {
        self.range_share(series, step_s).iter().all(|share| *share <= 1.0 + 1e-6)
    }

    /// How much of the way to the ends of their ranges the joints need.
    pub fn range_share(&self, series: &Series, step_s: f64) -> [f64; 3] {
        let range = &self.settings.range;
        if !range.is_there() {
            return [0.0; 3];
        }
        let count = (self.settings.period_s / step_s).round() as usize;
        range.share(&series.centre_rad, series.beginning(step_s).chain(series.period(count)))
    }

    /// A motion made smaller, joint by joint, for its velocity limits and its range. A smaller
    /// motion brakes in less than its share of the distance.
    fn within_limits_of_joints(&self, wanted: &Series, step_s: f64) -> (Series, Demand) {
        let share = self.demand(wanted, step_s).velocity_share(&self.settings.limits);
        let series = wanted.scaled(share.map(|share| 1.0 / share.max(1.0)));
        let share = self.range_share(&series, step_s);
        let series = series.scaled(share.map(|share| 1.0 / share.max(1.0)));
        (series, self.demand(&series, step_s))
    }
}
