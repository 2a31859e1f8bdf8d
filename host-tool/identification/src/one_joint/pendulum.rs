//! Rigs of one joint with a coarse encoder, the pendulum with friction of eq. (11), from any
//! log in which it moves.
//!
//! Sliding friction, inertia, gravity and an offset by robust least squares on smoothed
//! motion; the delay between the recorded torque and the motion is estimated too. Logs in
//! which somebody moved the joint are left out: there the command is a mere function of
//! the position, and inertia shows nowhere in it.

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use super::sandwich;
use crate::estimate::Estimate;
use recordings::StepError;
use recordings::campaign::{Known, Trace};
use recordings::one_joint::{check_driven, motion, slow_below};
use recordings::smoothed::SmoothedMotion;

/// The parameters of one joint.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OneJoint {
    /// Joint, 1 to 3.
    pub joint: u8,
    /// Inertia J [kg m^2].
    pub inertia_kg_m2: Estimate,
    /// Gravity torque l [Nm], at q = 90 degrees from hanging down.
    #[serde(rename = "gravity_torque_Nm")]
    pub gravity_torque_nm: Estimate,
    /// l / J [1/s^2], which no error of the torque constant reaches.
    pub swing_frequency_squared_per_s2: Estimate,
    /// Coulomb friction alpha_0 [V], Nm where the command is a torque.
    #[serde(rename = "alpha0_V")]
    pub alpha0_v: Estimate,
    /// Viscous friction alpha_2 [V s/rad].
    #[serde(rename = "alpha2_V_s_per_rad")]
    pub alpha2_v_s_per_rad: Estimate,
    /// Constant part of the command [V].
    #[serde(rename = "offset_V")]
    pub offset_v: Estimate,
    /// How much the motion comes after the command [s].
    pub delay_s: f64,
    /// RMS of the command that is left, the largest residuals counted less [V].
    #[serde(rename = "residual_rms_V")]
    pub residual_rms_v: f64,
    /// RMS of the smoothed command [V].
    #[serde(rename = "command_rms_V")]
    pub command_rms_v: f64,
    /// Logs that were used.
    pub used: Vec<String>,
    /// Logs that were not, and why.
    pub left_out: Vec<(String, String)>,
}

/// Columns: acceleration, sin q, velocity, its sign, one.
const COLUMNS: usize = 5;
/// Blocks for the standard errors [s].
const BLOCK_S: f64 = 0.5;

/// Identifies a rig of one joint from logs of it.
///
/// # Errors
/// No log has the joint, or in none does its command explain its motion.
pub fn identify(traces: &[&Trace], joint: u8, known: &Known) -> Result<OneJoint, StepError> {
    let mut left_out = Vec::new();
    let mut usable = Vec::new();
    for trace in traces {
        match check_driven(trace, joint, known) {
            Err(why) => left_out.push((trace.file.clone(), why.to_string())),
            Ok(()) => usable.push(*trace),
        }
    }
    if usable.is_empty() {
        let why: Vec<String> =
            left_out.iter().map(|(file, why)| format!("{file}: {why}")).collect();
        let what =
            format!("no log can be used ({}); record one driven by the motor", why.join("; "));
        return Err(StepError::Numerical { step: "one joint", what });
    }
    let tried = DELAYS_S.iter().map(|&delay_s| fit(&rows(&usable, joint, known, delay_s), delay_s));
    let best = tried.min_by(|a, b| a.scale_v.total_cmp(&b.scale_v));
    let best = best.filter(|fit| fit.solution[0] > 0.0).ok_or_else(|| StepError::Numerical {
        step: "one joint",
        what: "the command does not explain the motion: inertia comes out negative; \
               check the signs of angle and command"
            .to_owned(),
    })?;
    let used = usable.iter().map(|trace| trace.file.clone()).collect();
    Ok(result(&best, joint, known.torque_constant(joint), used, left_out))
}

/// Delays that are tried [s].
const DELAYS_S: [f64; 9] = [-0.005, 0.0, 0.005, 0.01, 0.015, 0.02, 0.025, 0.03, 0.04];

/// A joint's rows over several logs.
struct Table {
    regressors: DMatrix<f64>,
    command_v: DVector<f64>,
    rows_per_block: usize,
}

fn rows(traces: &[&Trace], joint: u8, known: &Known, delay_s: f64) -> Table {
    let motions: Vec<SmoothedMotion> =
        traces.iter().filter_map(|trace| motion(trace, joint, known, delay_s)).collect();
    let step_s = motions.first().map_or(1.0, |motion| motion.step_s);
    let (mut flat, mut command) = (Vec::new(), Vec::new());
    for motion in &motions {
        let slow = slow_below(motion);
        for k in 0..motion.len() {
            let velocity = motion.qd_rad_per_s[k];
            if velocity.abs() > slow && motion.measured[k] {
                let (sine, sign) = (motion.q_rad[k].sin(), velocity.signum());
                flat.extend([motion.qdd_rad_per_s2[k], sine, velocity, sign, 1.0]);
                command.push(motion.command_v[k]);
            }
        }
    }
    Table {
        regressors: DMatrix::from_row_slice(command.len(), COLUMNS, &flat),
        command_v: DVector::from_vec(command),
        rows_per_block: (BLOCK_S / step_s).ceil() as usize,
    }
}

struct RobustFit {
    solution: DVector<f64>,
    covariance: DMatrix<f64>,
    /// Robust standard deviation of the residual [V].
    scale_v: f64,
    rms_v: f64,
    command_rms_v: f64,
    delay_s: f64,
}

/// Least squares in which residuals beyond 1.5 standard deviations count by their size
/// only (Huber): the recorded torque has spikes of ten times what the motion shows.
fn fit(table: &Table, delay_s: f64) -> RobustFit {
    const ROUNDS: usize = 15;
    const BEND: f64 = 1.5;
    const MAD_TO_DEVIATION: f64 = 1.4826;
    let count = table.command_v.len();
    let mut weight = DVector::from_element(count, 1.0);
    let mut solution = DVector::zeros(COLUMNS);
    let mut residual = table.command_v.clone();
    let mut scale_v = f64::INFINITY;
    for _ in 0..ROUNDS {
        let weighted = weighted(&table.regressors, &weight);
        let command = table.command_v.component_mul(&weight);
        let Ok(next) = weighted.svd(true, true).solve(&command, 1e-12) else { break };
        solution = next;
        residual = &table.command_v - &table.regressors * &solution;
        let mut sizes: Vec<f64> = residual.iter().map(|r| r.abs()).collect();
        let middle = count / 2;
        if count == 0 {
            break;
        }
        scale_v = MAD_TO_DEVIATION * *sizes.select_nth_unstable_by(middle, f64::total_cmp).1;
        let edge = BEND * scale_v.max(1e-12);
        weight = residual.map(|r| if r.abs() <= edge { 1.0 } else { (edge / r.abs()).sqrt() });
    }
    let jacobian = weighted(&table.regressors, &weight);
    let remaining = residual.component_mul(&weight);
    let rows = count.max(1) as f64;
    RobustFit {
        covariance: sandwich::covariance(&jacobian, &remaining, table.rows_per_block, 0.0),
        solution,
        scale_v,
        rms_v: (remaining.norm_squared() / rows).sqrt(),
        command_rms_v: (table.command_v.norm_squared() / rows).sqrt(),
        delay_s,
    }
}

fn weighted(matrix: &DMatrix<f64>, weight: &DVector<f64>) -> DMatrix<f64> {
    DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)] * weight[i])
}

fn result(
    fit: &RobustFit,
    joint: u8,
    k_t: f64,
    used: Vec<String>,
    left_out: Vec<(String, String)>,
) -> OneJoint {
    let error = |k: usize| fit.covariance[(k, k)].max(0.0).sqrt();
    let volts = |k: usize| Estimate::new(fit.solution[k], error(k));
    let torque = |k: usize| Estimate::new(k_t * fit.solution[k], k_t * error(k));
    OneJoint {
        joint,
        inertia_kg_m2: torque(0),
        gravity_torque_nm: torque(1),
        swing_frequency_squared_per_s2: ratio(fit),
        alpha0_v: positive(volts(3)),
        alpha2_v_s_per_rad: positive(volts(2)),
        offset_v: volts(4),
        delay_s: fit.delay_s,
        residual_rms_v: fit.rms_v,
        command_rms_v: fit.command_rms_v,
        used,
        left_out,
    }
}

/// Friction is not negative; a value below zero says that the data do not carry it.
fn positive(estimate: Estimate) -> Estimate {
    if estimate.value > 0.0 {
        return estimate;
    }
    let interval = [0.0, estimate.interval[1].max(0.0)];
    let bounded = Estimate { value: 0.0, interval, ..estimate };
    bounded.with_note("the data do not carry it")
}

/// l / J with its error.
fn ratio(fit: &RobustFit) -> Estimate {
    let (j, l) = (fit.solution[0], fit.solution[1]);
    let value = l / j;
    let c = &fit.covariance;
    let variance = (c[(1, 1)] - 2.0 * value * c[(0, 1)] + value * value * c[(0, 0)]) / (j * j);
    Estimate::new(value, variance.max(0.0).sqrt())
}
