//! The logs as weighted rows, on which all models are compared.

use std::sync::OnceLock;

use super::noise::{Noise, NoiseByRate};
use super::row_filter::RowFilter;
use crate::logs::stretch::Stretch;
use files::Role;

/// Stretches with the filters and weights of their rows.
#[derive(Clone, Debug)]
pub struct Evidence {
    /// The stretches, those of train logs first.
    pub stretches: Vec<Stretch>,
    /// Joints of the rig, 0 to 2.
    pub joints: Vec<usize>,
    /// Filter of a joint's rows in a stretch, by joint.
    filters: [Vec<RowFilter>; 3],
    /// Noise of a joint's rows in a stretch, rms [V], by joint.
    floors_v: [Vec<f64>; 3],
    /// What encoder steps alone leave of them, rms [V], by joint.
    steps_v: [Vec<f64>; 3],
    /// Stretches of train logs.
    train: usize,
    /// Rows of the regressor along the measured motion, by stretch and joint, once asked for.
    regressors: Vec<[OnceLock<Columns>; 3]>,
}

/// Columns of rows, one per base parameter, empty where it does not count.
pub type Columns = Vec<Vec<f64>>;

/// Rows of the three joints, each in units of its noise; empty where a joint has none.
pub type Rows = [Vec<f64>; 3];

/// Part of a command too fast for the sampling that is not accounted for, per second between
/// samples: how the joint moves meanwhile is not known, nor what its friction does.
const BETWEEN_SAMPLES_PER_S: f64 = 10.0;

impl Evidence {
    /// Stretches as rows that are white for this noise.
    pub fn new(mut stretches: Vec<Stretch>, joints: Vec<usize>, noise: &NoiseByRate) -> Self {
        stretches.sort_by_key(|stretch| stretch.role == Role::Holdout);
        let train = stretches.iter().filter(|s| s.role == Role::Train).count();
        let filters = [0, 1, 2].map(|joint| {
            let filter = |s: &Stretch| {
                let corner_hz =
                    noise.of(joint, s.period_s).corner_hz().clamp(2.0, 0.4 / s.period_s);
                RowFilter::new(s.period_s, s.broadband, corner_hz)
            };
            stretches.iter().map(filter).collect::<Vec<_>>()
        });
        let behind = |filter: &RowFilter, s: &Stretch, noise: Noise| {
            noise.behind(|f| filter.gain(f), s.period_s)
        };
        let floors_v = [0, 1, 2].map(|joint| {
            let floor = |(s, filter): (&Stretch, &RowFilter)| {
                let seen_v = behind(filter, s, noise.of(joint, s.period_s));
                seen_v.hypot(BETWEEN_SAMPLES_PER_S * s.period_s * s.fast_command_v(joint))
            };
            stretches.iter().zip(&filters[joint]).map(floor).collect()
        });
        let steps_v = [0, 1, 2].map(|joint| {
            let steps = |(s, filter): (&Stretch, &RowFilter)| {
                behind(filter, s, noise.of_steps(joint, s.period_s))
            };
            stretches.iter().zip(&filters[joint]).map(steps).collect()
        });
        let regressors = stretches.iter().map(|_| Default::default()).collect();
        Self { stretches, joints, filters, floors_v, steps_v, train, regressors }
    }

    /// The regressor's rows of a joint along the measured motion; made by `make` at first.
    pub fn regressor(&self, s: usize, joint: usize, make: impl FnOnce() -> Columns) -> &Columns {
        self.regressors[s][joint].get_or_init(make)
    }

    /// A signal of a stretch as rows in units of the noise; zero before the joint's
    /// friction is settled.
    pub fn weighted(&self, s: usize, joint: usize, signal: &[f64]) -> Vec<f64> {
        let stretch = &self.stretches[s];
        let filter = &self.filters[joint][s];
        let unit = 1.0 / self.floors_v[joint][s];
        let mut rows = filter.rows(signal);
        for (row, instant) in rows.iter_mut().zip(filter.instants(signal.len())) {
            *row *= if instant < stretch.settled[joint] { 0.0 } else { unit };
        }
        rows
    }

    /// Filter of a joint's rows in a stretch.
    pub fn filter(&self, joint: usize, s: usize) -> &RowFilter {
        &self.filters[joint][s]
    }

    /// Noise of a joint's rows in a stretch, rms [V].
    pub fn floor_v(&self, joint: usize, s: usize) -> f64 {
        self.floors_v[joint][s]
    }

    /// What the encoder's steps must leave of a joint's rows in a stretch, rms [V].
    pub fn steps_v(&self, joint: usize, s: usize) -> f64 {
        self.steps_v[joint][s]
    }

    /// Rows of a joint in a stretch.
    pub fn row_count(&self, joint: usize, s: usize) -> usize {
        self.filters[joint][s].row_count(self.stretches[s].len())
    }

    /// Where a joint's rows of each stretch lie among all of its rows.
    pub fn ranges(&self, joint: usize) -> Vec<std::ops::Range<usize>> {
        let mut begin = 0;
        let range = |s: usize| {
            let end = begin + self.row_count(joint, s);
            std::mem::replace(&mut begin, end)..end
        };
        (0..self.stretches.len()).map(range).collect()
    }

    /// Rows of a joint that belong to train logs; they come first.
    pub fn train_rows(&self, joint: usize) -> usize {
        (0..self.train).map(|s| self.row_count(joint, s)).sum()
    }

    /// Stretches of train logs; they come first.
    pub fn train_stretches(&self) -> usize {
        self.train
    }
}
