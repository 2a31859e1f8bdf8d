//! The logs as weighted rows, on which all models are compared.

use std::ops::Range;
use std::sync::{Arc, OnceLock};

use super::floors::{behind, filters, floor_v};
use super::noise::NoiseByRate;
use super::row_filter::RowFilter;
use crate::criteria::Criteria;
use crate::logs::stretch::Stretch;
use files::Role;

/// Stretches with the filters and weights of their rows.
#[derive(Clone, Debug)]
pub struct Evidence {
    /// The stretches, those of train logs first.
    pub stretches: Arc<[Stretch]>,
    /// Joints of the rig, from 0.
    pub joints: Vec<usize>,
    /// Filter of a joint's rows in a stretch, by joint.
    pub(super) filters: Vec<Vec<RowFilter>>,
    /// Noise of a joint's rows in a stretch, rms [V], by joint.
    floors_v: Vec<Vec<f64>>,
    /// What encoder steps alone leave of them, rms [V], by joint.
    steps_v: Vec<Vec<f64>>,
    /// Stretches of train logs.
    pub(super) train: usize,
    /// The thresholds by which models are compared.
    pub criteria: Criteria,
    /// Whether what a model leaves beyond noise counts as systematic: the same again and again, of which a
    /// log says no more however many rows it has.
    pub systematic: bool,
    /// Rows of the regressor along the measured motion, by stretch and joint, once asked for [V per
    /// unit of the base parameter].
    regressors: Arc<[Vec<OnceLock<Columns>>]>,
    /// Rows of what one rigid body needs along it; likewise.
    rigid_rows: Arc<[Vec<OnceLock<RigidRows>>]>,
    /// The part for which every row of a stretch counts, by joint; 0 before the joint's friction is settled.
    known: Vec<Vec<Vec<f64>>>,
    /// Weight of every row of a stretch, by joint, that part in it [1/V].
    weights: Vec<Vec<Vec<f64>>>,
}

/// Columns of a joint's rows, one per base parameter; none where the joint does not depend on it.
pub type Columns = Vec<Option<Vec<f64>>>;

/// Rows of what a rigid body needs of a joint, without weights, counted as negative.
#[derive(Clone, Debug)]
pub struct RigidRows {
    /// Base parameters or coordinates of the body.
    pub base: Vec<f64>,
    /// Its rows [V].
    pub rows: Vec<f64>,
}

/// Rows of the arm's joints, weighted or in volts. A joint that the rig lacks has no row.
pub type Rows = Vec<Vec<f64>>;

/// Change of the rows of each joint, those held out last or not at all; none where a joint's rows
/// do not change. An empty list changes no joint's.
pub type RowChange = Vec<Option<Vec<f64>>>;

impl Evidence {
    /// Stretches as rows that are white for this noise.
    pub fn new(
        mut stretches: Vec<Stretch>,
        joints: Vec<usize>,
        noise: &NoiseByRate,
        criteria: &Criteria,
    ) -> Self {
        stretches.sort_by_key(|stretch| stretch.role == Role::Holdout);
        let count = stretches.first().map_or(0, |stretch| stretch.command_v.len());
        let filters: Vec<Vec<RowFilter>> =
            (0..count).map(|joint| filters(&stretches, joint, noise, criteria)).collect();
        let of_all = |joint: usize, of: &dyn Fn(&Stretch, &RowFilter) -> f64| {
            let both = stretches.iter().zip(&filters[joint]);
            both.map(|(stretch, filter)| of(stretch, filter)).collect::<Vec<f64>>()
        };
        let floors_v = (0..count)
            .map(|joint| of_all(joint, &|s, f| floor_v(s, f, joint, noise, criteria)))
            .collect();
        let steps_v = (0..count)
            .map(|joint| of_all(joint, &|s, f| behind(f, s, noise.of_steps(joint, s.sampled_s))))
            .collect();
        let mut evidence = Self {
            train: stretches.iter().filter(|s| s.role == Role::Train).count(),
            regressors: stretches.iter().map(of_joints).collect(),
            rigid_rows: stretches.iter().map(of_joints).collect(),
            stretches: stretches.into(),
            joints,
            filters,
            floors_v,
            steps_v,
            criteria: criteria.clone(),
            systematic: false,
            known: Default::default(),
            weights: Default::default(),
        };
        evidence.weigh_by_noise();
        evidence
    }

    /// Gives rows their weights as if what is left were noise alone.
    fn weigh_by_noise(&mut self) {
        let of_joint = |joint| (0..self.stretches.len()).map(|s| self.known(joint, s)).collect();
        self.known = (0..self.joint_count()).map(of_joint).collect();
        self.weights.clone_from(&self.known);
        for (of_joint, floors_v) in self.weights.iter_mut().zip(&self.floors_v) {
            for (weights, floor_v) in of_joint.iter_mut().zip(floors_v) {
                weights.iter_mut().for_each(|weight| *weight /= floor_v);
            }
        }
    }

    /// The part for which a joint's rows in a stretch count: none before its friction is settled, or where they see a
    /// sample at which the motion is not known.
    fn known(&self, joint: usize, s: usize) -> Vec<f64> {
        let stretch = &self.stretches[s];
        let part = |k: usize| {
            let is_seen = stretch.unseen.get(k).is_none_or(|unseen| !unseen);
            let is_settled = k >= stretch.settled[joint];
            let known_part = stretch.known_part[joint].get(k).copied().unwrap_or(1.0);
            if is_settled && is_seen { known_part } else { 0.0 }
        };
        self.filters[joint][s].instants(stretch.len()).map(part).collect()
    }

    /// The same rows with other weights of train rows [1/V], by joint and stretch; what is held out
    /// keeps its own, and rows before friction is settled have none.
    pub fn with_train_weights(&self, weights: impl Fn(usize, usize) -> Vec<f64>) -> Self {
        let mut evidence = self.clone();
        for &joint in &self.joints {
            for s in 0..self.train {
                let both = weights(joint, s).into_iter().zip(&self.known[joint][s]);
                evidence.weights[joint][s] = both.map(|(weight, part)| weight * part).collect();
            }
        }
        evidence
    }

    /// The same rows, by the part for which each joint's samples count in a stretch; weights are those of noise.
    pub fn with_known_parts(&self, part: impl Fn(&Self, usize, usize) -> Vec<f64>) -> Self {
        let mut stretches = self.stretches.to_vec();
        for (s, stretch) in stretches.iter_mut().enumerate() {
            for &joint in &self.joints {
                stretch.known_part[joint] = part(self, joint, s);
            }
        }
        let mut evidence = Self { stretches: stretches.into(), ..self.clone() };
        evidence.weigh_by_noise();
        evidence
    }

    /// The part of a log's rows of a joint that lie in a stretch: samples that are missing part a log.
    pub fn part_of_log(&self, joint: usize, s: usize) -> f64 {
        let log = self.stretches[s].log;
        let of_log = (0..self.stretches.len()).filter(|other| self.stretches[*other].log == log);
        let rows: usize = of_log.map(|s| self.row_count(joint, s)).sum();
        self.row_count(joint, s) as f64 / rows.max(1) as f64
    }

    /// The same rows of stretches that are changed, but begin where they began; each keeps its
    /// noise.
    pub fn with_stretches(&self, change: impl Fn(&mut Stretch)) -> Self {
        let mut stretches = self.stretches.to_vec();
        stretches.iter_mut().for_each(change);
        let regressors = stretches.iter().map(of_joints).collect();
        let rigid_rows = stretches.iter().map(of_joints).collect();
        let stretches = stretches.into();
        let mut changed = Self { stretches, regressors, rigid_rows, ..self.clone() };
        for joint in 0..changed.weights.len() {
            changed.weights[joint].truncate(changed.stretches.len());
            changed.known[joint].truncate(changed.stretches.len());
            for s in 0..changed.weights[joint].len() {
                let count = changed.row_count(joint, s);
                changed.weights[joint][s].truncate(count);
                changed.known[joint][s].truncate(count);
            }
        }
        changed
    }

    /// The same without what is held out.
    pub fn train_only(&self) -> Self {
        let stretches = self.stretches[..self.train].to_vec();
        Self { stretches: stretches.into(), ..self.clone() }.with_stretches(|_| ())
    }

    /// How many joints the arm has.
    pub fn joint_count(&self) -> usize {
        self.filters.len()
    }

    /// Rows of all joints, none yet.
    pub fn no_rows(&self) -> Rows {
        vec![Vec::new(); self.joint_count()]
    }

    /// A change of rows that changes none yet.
    pub fn no_change(&self) -> RowChange {
        vec![None; self.joint_count()]
    }

    /// The regressor's rows of a joint along the measured motion, without weights; made by `make`
    /// at first.
    pub fn regressor(&self, s: usize, joint: usize, make: impl FnOnce() -> Columns) -> &Columns {
        self.regressors[s][joint].get_or_init(make)
    }

    /// Rows of what a rigid body needs of a joint along the measured motion, without weights; made by `make` at first.
    pub fn rigid_rows(
        &self,
        s: usize,
        joint: usize,
        make: impl FnOnce() -> RigidRows,
    ) -> &RigidRows {
        self.rigid_rows[s][joint].get_or_init(make)
    }

    /// A signal of a stretch as weighted rows. Rows before the joint's friction is settled have no
    /// weight: they are zero, and add to no sum.
    pub fn weighted(&self, s: usize, joint: usize, signal: &[f64]) -> Vec<f64> {
        let mut rows = self.filters[joint][s].rows(signal);
        self.weigh(s, joint, &mut rows);
        rows
    }

    /// Gives rows of a stretch their weights.
    pub fn weigh(&self, s: usize, joint: usize, rows: &mut [f64]) {
        rows.iter_mut().zip(&self.weights[joint][s]).for_each(|(row, weight)| *row *= weight);
    }

    /// Weights of all rows of a joint [1/V].
    pub fn weights(&self, joint: usize) -> impl Iterator<Item = f64> {
        self.weights[joint].iter().flatten().copied()
    }

    /// By what rows of a joint with these weights are scaled to have those of other rows; by nothing where they have none.
    pub fn ratios_to<'a>(&'a self, to: &'a Self, joint: usize) -> impl Iterator<Item = f64> + 'a {
        let both = self.weights(joint).zip(to.weights(joint));
        both.map(|(from, to)| if from > 0.0 { to / from } else { 0.0 })
    }

    /// A change of rows with these weights as one of rows with other weights.
    pub fn change_on(&self, to: &Self, change: &RowChange) -> RowChange {
        let of_joint = |(joint, rows): (usize, &Option<Vec<f64>>)| {
            let both = rows.as_ref()?.iter().zip(self.ratios_to(to, joint));
            Some(both.map(|(row, ratio)| row * ratio).collect())
        };
        change.iter().enumerate().map(of_joint).collect()
    }

    /// Weighted rows of all joints in volts, by the part for which each counts; those without weight are zero.
    pub fn volts(&self, rows: &Rows) -> Rows {
        let in_volts = |joint: usize| {
            let known = self.known[joint].iter().flatten();
            let both = rows[joint].iter().zip(self.weights(joint)).zip(known);
            both.map(|((row, weight), part)| if weight > 0.0 { row / weight * part } else { 0.0 })
                .collect()
        };
        (0..self.joint_count()).map(in_volts).collect()
    }

    /// How many rows of a joint in a stretch have weight.
    pub fn used_rows(&self, joint: usize, s: usize) -> usize {
        self.weights[joint][s].iter().filter(|weight| **weight > 0.0).count()
    }

    /// How many of some rows of a joint, counted from the stretch's first, have weight.
    pub fn used_between(&self, joint: usize, s: usize, rows: Range<usize>) -> usize {
        self.weights[joint][s][rows].iter().filter(|weight| **weight > 0.0).count()
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
}

/// Room for what a stretch has of each joint.
fn of_joints<T>(stretch: &Stretch) -> Vec<OnceLock<T>> {
    stretch.command_v.iter().map(|_| OnceLock::new()).collect()
}
