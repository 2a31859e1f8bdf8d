//! Rows of all logs, and what is to be found by them.

use files::ArmFile;
use nalgebra::DMatrix;

use super::condensed::Condensed;
use super::friction_terms::FrictionTerms;
use super::layout::Layout;
use super::logs::PreparedLog;
use super::motion::CommandTime;
use super::rows::{Equations, JointRows, StretchRows};
use super::settings::Settings;
use super::unknowns::Unknowns;
use super::weights::{left_of, weights};

/// What a fit is made of.
pub struct Fitting<'a> {
    /// When commands act.
    pub time: CommandTime,
    /// How rows come of logs.
    pub equations: Equations<'a>,
    /// What can be chosen.
    pub settings: &'a Settings,
    arm: &'a ArmFile,
    logs: &'a [PreparedLog],
    /// Rows without terms.
    stretches: Vec<StretchRows>,
}

impl<'a> Fitting<'a> {
    /// Of an arm and its logs.
    pub fn new(
        arm: &'a ArmFile,
        logs: &'a [PreparedLog],
        equations: Equations<'a>,
        time: CommandTime,
        settings: &'a Settings,
    ) -> Self {
        let of_log = |log: &PreparedLog| log.rows(&equations, time, settings);
        let stretches = logs.iter().flat_map(of_log).collect();
        Self { time, equations, settings, arm, logs, stretches }
    }

    /// The rows of all logs.
    pub fn rows(&self, terms: &FrictionTerms) -> WeightedRows {
        let layout = self.layout();
        let with_terms = |stretch: &StretchRows| stretch.with(terms);
        let all: Vec<JointRows> = self.stretches.iter().flat_map(with_terms).collect();
        let condensed = Condensed::of(&all, layout);
        let weights = weights(&all, &condensed, layout, self.settings);
        WeightedRows { rows: condensed.weighted(&weights), all, weights, layout }
    }

    /// Largest velocity of each joint [rad/s; m/s].
    pub fn fastest(&self) -> Vec<f64> {
        scales(self.logs).into_iter().map(|[_, fastest]| fastest).collect()
    }

    /// Smallest velocity of each joint's rows [rad/s; m/s].
    pub fn slowest(&self) -> Vec<f64> {
        let of_joint = |joint: usize| {
            self.logs.iter().map(|log| log.band.standstill[joint]).fold(f64::INFINITY, f64::min)
        };
        (0..self.layout().joints).map(of_joint).collect()
    }

    /// Whether a joint's peak of friction is sought: one that is given stays.
    pub fn seeks_peak(&self, joint: usize) -> bool {
        self.equations.friction[joint].peak().is_none()
    }

    /// Where numbers stand.
    pub fn layout(&self) -> Layout {
        Layout { joints: self.equations.constants.len() }
    }

    /// What is searched, with terms.
    pub fn unknowns(&self, terms: &FrictionTerms) -> Unknowns {
        let constants = self.equations.constants;
        let mut unknowns = Unknowns::of(self.arm, constants, &scales(self.logs), self.settings);
        for (joint, terms) in unknowns.joints.iter_mut().zip(&terms.joints) {
            joint.terms = terms.open;
        }
        unknowns
    }
}

/// The rows of all logs.
pub struct WeightedRows {
    /// One by one.
    pub all: Vec<JointRows>,
    /// Condensed and weighted.
    pub rows: DMatrix<f64>,
    /// Weight of each joint's rows.
    pub weights: Vec<f64>,
    layout: Layout,
}

impl WeightedRows {
    /// Which joints have rows enough.
    pub fn moves(&self, settings: &Settings) -> Vec<bool> {
        let is_enough = |joint| count(&self.all, joint) >= settings.fewest_rows;
        (0..self.layout.joints).map(is_enough).collect()
    }

    /// Squares that the numbers leave of a joint's command.
    pub fn squares(&self, joint: usize, numbers: &[f64]) -> f64 {
        let left = left_of(&self.all, joint, numbers, self.layout);
        left.iter().flatten().map(|left| left * left).sum()
    }
}

/// Rows of a joint.
pub fn count(rows: &[JointRows], joint: usize) -> usize {
    let of_joint = rows.iter().filter(|rows| rows.joint == joint);
    of_joint.map(|rows| rows.command.len()).sum()
}

fn scales(logs: &[PreparedLog]) -> Vec<[f64; 2]> {
    let larger = |a: Vec<[f64; 2]>, b: Vec<[f64; 2]>| {
        a.iter().zip(&b).map(|(a, b)| [a[0].max(b[0]), a[1].max(b[1])]).collect()
    };
    logs.iter().map(PreparedLog::scales).reduce(larger).unwrap_or_default()
}
