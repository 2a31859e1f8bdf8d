//! Limits of the motion and effort of the search.

use std::f64::consts::{FRAC_PI_2, PI};
use std::time::Duration;

use super::range::Range;

/// What the motion must keep to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Largest velocity of each joint [rad/s], section 4.2.
    pub velocity_rad_per_s: [f64; 3],
    /// Share of it that the design may use: joints overshoot their references.
    pub velocity_share: f64,
    /// Largest command [V].
    pub command_v: f64,
    /// Share of it that the design may use: feedback needs the rest.
    pub command_share: f64,
}

impl Limits {
    /// The paper's velocities, and a converter's limit.
    pub fn of_paper(command_v: f64) -> Self {
        Self {
            velocity_rad_per_s: [2.0 * PI, 3.0 * PI, 3.0 * PI],
            velocity_share: 0.95,
            command_v,
            command_share: 0.9,
        }
    }

    /// The peak velocities that a design may have [rad/s].
    pub fn usable_velocity_rad_per_s(&self) -> [f64; 3] {
        self.velocity_rad_per_s.map(|limit| self.velocity_share * limit)
    }

    /// The peak voltage that a design may need [V].
    pub fn usable_command_v(&self) -> f64 {
        self.command_share * self.command_v
    }
}

/// How long the search goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effort {
    /// Starts from different random motions; the best result counts.
    pub starts: u32,
    /// Generations of each start, at most.
    pub generations: u32,
    /// Motions tried in each generation.
    pub population: u32,
    /// The search ends when this has passed, and then no longer depends on `seed` alone.
    pub time_limit: Option<Duration>,
}

impl Default for Effort {
    fn default() -> Self {
        Self { starts: 16, generations: 600, population: 16, time_limit: None }
    }
}

/// A task of design.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// What the motion must keep to.
    pub limits: Limits,
    /// The joints' ranges, in which it stays.
    pub range: Range,
    /// The motion's period [s].
    pub period_s: f64,
    /// Where each joint begins [rad]: the arm hangs, and may be left to itself there.
    pub centre_rad: [f64; 3],
    /// Time in which the motion swells from rest [s].
    pub fade_in_s: f64,
    /// Time between the samples of Phi [s].
    pub sample_period_s: f64,
    /// How long the search goes on.
    pub effort: Effort,
    /// Same seed, same motion.
    pub seed: u64,
}

impl Settings {
    /// The paper's period, samples and limits.
    pub fn of_paper(command_limit_v: f64) -> Self {
        Self {
            limits: Limits::of_paper(command_limit_v),
            range: Range::default(),
            period_s: 10.0,
            centre_rad: [0.0, -FRAC_PI_2, 0.0],
            fade_in_s: 2.0,
            sample_period_s: 0.01,
            effort: Effort::default(),
            seed: 1,
        }
    }
}
