//! Rows of the regression: filtered regressor and command of one joint, where it moves.

use files::arm_file::ArmFriction;
use model::chain::SerialChain;
use model::mechanism::Mechanism;
use nalgebra::DMatrix;
use signal::LowPass;

use super::band::Band;
use super::friction_terms::FrictionTerms;
use super::layout::Layout;
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

/// Rows of a stretch without terms beyond Coulomb's level and viscous friction.
#[derive(Clone, Debug)]
pub struct StretchRows {
    motion: Motion,
    filter: LowPass,
    joints: Vec<BareRows>,
}

/// Those of a joint.
#[derive(Clone, Debug)]
struct BareRows {
    /// Samples that become rows.
    kept: Vec<usize>,
    /// Filtered columns, one after the other.
    columns: Vec<f64>,
    command: Vec<f64>,
}

impl StretchRows {
    /// The rows with terms, one entry per joint.
    pub fn with(&self, terms: &FrictionTerms) -> Vec<JointRows> {
        let width = Layout { joints: self.joints.len() }.of_row();
        let both = self.joints.iter().zip(terms.columns(&self.motion)).enumerate();
        both.map(|(joint, (bare, terms))| {
            let terms = terms.iter().flat_map(|term| thinned(&self.filter, term, &bare.kept));
            let columns = bare.columns.iter().copied().chain(terms).collect();
            let rows = DMatrix::from_vec(bare.kept.len(), width, columns);
            JointRows { joint, rows, command: bare.command.clone() }
        })
        .collect()
    }
}

/// A signal, filtered, at some of its samples; nothing stays nothing.
fn thinned(filter: &LowPass, signal: &[f64], kept: &[usize]) -> Vec<f64> {
    if signal.iter().all(|value| *value == 0.0) {
        return vec![0.0; kept.len()];
    }
    let smooth = filter.zero_phase(signal);
    kept.iter().map(|&sample| smooth[sample]).collect()
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
    /// The rows of a stretch.
    pub fn rows(&self, motion: Motion, band: &Band, settings: &Settings) -> StretchRows {
        let regressors = self.regressors(&motion);
        let filter = LowPass::new(band.second_hz, motion.period_s);
        let of_joint = |joint| {
            let kept = kept(&motion, joint, band, settings);
            let thin = |signal: &Vec<f64>| thinned(&filter, signal, &kept);
            let columns = self.columns(&motion, &regressors, joint).iter().flat_map(thin).collect();
            let command = thin(&self.less_peak(&motion, joint));
            BareRows { columns, command, kept }
        };
        let joints = (0..self.constants.len()).map(of_joint).collect();
        StretchRows { motion, filter, joints }
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

    /// Unfiltered columns of a joint's rows: links, Coulomb's level and viscous friction.
    fn columns(&self, motion: &Motion, regressors: &[Vec<f64>], joint: usize) -> Vec<Vec<f64>> {
        let links = self.chain.parameter_count();
        let of_link = |column: usize| {
            let entry = |rows: &Vec<f64>| rows[joint * links + column] / self.constants[joint];
            regressors.iter().map(entry).collect()
        };
        let velocity = &motion.states[1][joint];
        let signs = velocity.iter().map(|v| v.signum()).collect();
        (0..links).map(of_link).chain([signs, velocity.clone()]).collect()
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
