//! Rows of the regression: filtered regressor and command of one joint, where it moves.

use files::arm_file::ArmFriction;
use model::chain::SerialChain;
use model::mechanism::Mechanism;
use nalgebra::DMatrix;
use signal::LowPass;

use super::band::Band;
use super::friction_terms::FrictionTerms;
use super::layout::{Layout, TERMS};
use super::motion::Motion;
use super::settings::Settings;

/// Rows of one joint.
#[derive(Clone, Debug, PartialEq)]
pub struct JointRows {
    /// The joint, from 0.
    pub joint: usize,
    /// By the numbers of [`Layout::row_numbers`], in the unit of the command.
    pub rows: DMatrix<f64>,
    /// The command, less the Stribeck peak that the robot file gives.
    pub command: Vec<f64>,
}

/// What rows need to know of an arm.
#[derive(Clone, Copy)]
pub struct Equations<'a> {
    /// The chain; its link parameters do not matter.
    pub chain: &'a SerialChain<f64>,
    /// Torque by command per joint.
    pub constants: &'a [f64],
    /// Friction as given per joint.
    pub friction: &'a [ArmFriction],
}

impl Equations<'_> {
    /// The rows of a stretch, one entry per joint, with terms of friction.
    pub fn rows(
        &self,
        motion: &Motion,
        band: &Band,
        terms: &FrictionTerms,
        settings: &Settings,
    ) -> Vec<JointRows> {
        let regressors = self.regressors(motion);
        let mut terms = terms.columns(motion);
        let filter = LowPass::new(band.second_hz, motion.period_s);
        (0..self.constants.len())
            .map(|joint| {
                let kept = kept(motion, joint, band, settings);
                let thin = |signal: &[f64]| -> Vec<f64> {
                    let smooth = filter.zero_phase(signal);
                    kept.iter().map(|&sample| smooth[sample]).collect()
                };
                let columns =
                    self.columns(motion, &regressors, std::mem::take(&mut terms[joint]), joint);
                let columns: Vec<f64> = columns.iter().flat_map(|column| thin(column)).collect();
                let width = Layout { joints: self.constants.len() }.of_row();
                let rows = DMatrix::from_vec(kept.len(), width, columns);
                JointRows { joint, rows, command: thin(&self.less_peak(motion, joint)) }
            })
            .collect()
    }

    /// Regressors of all samples, each n x 11 n row by row.
    fn regressors(&self, motion: &Motion) -> Vec<Vec<f64>> {
        let size = self.chain.joints().count() * self.chain.parameter_count();
        let of_sample = |sample| {
            let [q, qd, qdd] = motion.at(sample);
            let mut rows = vec![0.0; size];
            self.chain.regressor(&q, &qd, &qdd, &mut rows);
            rows
        };
        (0..motion.len()).map(of_sample).collect()
    }

    /// Unfiltered columns of a joint's rows.
    fn columns(
        &self,
        motion: &Motion,
        regressors: &[Vec<f64>],
        terms: [Vec<f64>; TERMS],
        joint: usize,
    ) -> Vec<Vec<f64>> {
        let links = self.chain.parameter_count();
        let of_link = |column: usize| {
            let entry = |rows: &Vec<f64>| rows[joint * links + column] / self.constants[joint];
            regressors.iter().map(entry).collect()
        };
        let velocity = &motion.states[1][joint];
        let signs = velocity.iter().map(|v| v.signum()).collect();
        let friction = [signs, velocity.clone()].into_iter().chain(terms);
        (0..links).map(of_link).chain(friction).collect()
    }

    /// The command less the given Stribeck peak alpha1 exp(-(v/vs)^2) of eq. (10).
    fn less_peak(&self, motion: &Motion, joint: usize) -> Vec<f64> {
        let Some([height, width]) = self.friction[joint].peak() else {
            return motion.command[joint].clone();
        };
        let peak = |v: f64| height * (-(v / width).powi(2)).exp() * v.signum();
        let both = motion.command[joint].iter().zip(&motion.states[1][joint]);
        both.map(|(u, v)| u - peak(*v)).collect()
    }
}

/// Samples that become rows: every few, away from the ends, and where the joint moves and did so
/// for most of the second filter's reach.
fn kept(motion: &Motion, joint: usize, band: &Band, settings: &Settings) -> Vec<usize> {
    let period = 1.0 / (band.second_hz * motion.period_s);
    let edge = (settings.edge * period).ceil() as usize;
    let stride = (period / settings.rows_per_period).max(1.0) as usize;
    let reach = (period / 4.0).ceil() as usize;
    let velocity = &motion.states[1][joint];
    let stands = |sample: usize| velocity[sample].abs() < band.standstill[joint];
    let mostly_moves = |sample: usize| {
        let near = sample.saturating_sub(reach)..(sample + reach + 1).min(velocity.len());
        let count = near.len();
        2 * near.filter(|near| stands(*near)).count() < count
    };
    (edge..motion.len().saturating_sub(edge))
        .step_by(stride)
        .filter(|&sample| !stands(sample) && mostly_moves(sample))
        .collect()
}
