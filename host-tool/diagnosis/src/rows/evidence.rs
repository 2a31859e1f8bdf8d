//! The logs as weighted rows, on which all models are compared.

use std::sync::OnceLock;

use super::noise::{Noise, NoiseByRate};
use super::row_filter::RowFilter;
use crate::criteria::Criteria;
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
    /// The thresholds by which models are compared.
    pub criteria: Criteria,
    /// Rows of the regressor along the measured motion, by stretch and joint, once asked for.
    regressors: Vec<[OnceLock<Columns>; 3]>,
}

/// Columns of a joint's rows, one per base parameter; none where the joint does not depend on it.
pub type Columns = Vec<Option<Vec<f64>>>;

/// Rows of the arm's three joints, each in units of its noise. A joint that the rig lacks has no
/// row.
pub type Rows = [Vec<f64>; 3];

/// Change of the rows of each joint, those held out last or not at all; none where a joint's rows
/// do not change.
pub type RowChange = [Option<Vec<f64>>; 3];

impl Evidence {
    /// Stretches as rows that are white for this noise.
    pub fn new(
        mut stretches: Vec<Stretch>,
        joints: Vec<usize>,
        noise: &NoiseByRate,
        criteria: &Criteria,
    ) -> Self {
        let of_rows = &criteria.rows;
        stretches.sort_by_key(|stretch| stretch.role == Role::Holdout);
        let train = stretches.iter().filter(|s| s.role == Role::Train).count();
        let filters = [0, 1, 2].map(|joint| {
            let filter = |s: &Stretch| {
                let corner_hz = noise.of(joint, s.period_s).corner_hz();
                let highest_hz = of_rows.highest_corner_part / s.period_s;
                let corner_hz = corner_hz.clamp(of_rows.lowest_corner_hz, highest_hz);
                RowFilter::new(s.period_s, s.broadband, corner_hz, of_rows)
            };
            stretches.iter().map(filter).collect::<Vec<_>>()
        });
        let behind = |filter: &RowFilter, s: &Stretch, noise: Noise| {
            noise.behind(|f| filter.gain(f), s.period_s)
        };
        let floors_v = [0, 1, 2].map(|joint| {
            let floor = |(s, filter): (&Stretch, &RowFilter)| {
                let seen_v = behind(filter, s, noise.of(joint, s.period_s));
                let fast_v = s.fast_command_v(joint, criteria.logs.fast_part);
                seen_v.hypot(of_rows.between_samples_per_s * s.period_s * fast_v)
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
        let criteria = criteria.clone();
        Self { stretches, joints, filters, floors_v, steps_v, train, criteria, regressors }
    }

    /// The regressor's rows of a joint along the measured motion; made by `make` at first.
    pub fn regressor(&self, s: usize, joint: usize, make: impl FnOnce() -> Columns) -> &Columns {
        self.regressors[s][joint].get_or_init(make)
    }

    /// A signal of a stretch as rows in units of the noise. Rows before the joint's friction is
    /// settled have no weight: they are zero, and add to no sum.
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

    /// The first of a joint's rows in a stretch that has weight.
    pub fn first_settled_row(&self, joint: usize, s: usize) -> usize {
        let stretch = &self.stretches[s];
        let instants = self.filters[joint][s].instants(stretch.len());
        instants.take_while(|&instant| instant < stretch.settled[joint]).count()
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
