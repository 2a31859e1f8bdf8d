//! Rigs of one joint with a coarse encoder, eq. (11), from any log in which it moves.
//!
//! Sliding friction, inertia, gravity and an offset by robust least squares on smoothed
//! motion; the delay between the recorded torque and the motion is found along. Logs in
//! which somebody moved the joint are left out: there the command is a mere function of
//! the position, and inertia shows nowhere in it.

use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use super::motion::{Motion, Smoothing, smoothed, typical_period_s};
use super::sandwich;
use crate::estimate::Estimate;
use recordings::StepError;
use recordings::campaign::{Known, Trace};

/// What a log of one joint told.
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
        match why_not(trace, joint, known) {
            Some(why) => left_out.push((trace.file.clone(), why)),
            None => usable.push(*trace),
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
    let motions: Vec<Motion> =
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

/// Below this the sign of the velocity is not sure [rad/s].
fn slow_below(motion: &Motion) -> f64 {
    const SHARE: f64 = 0.05;
    let squares: f64 = motion.qd_rad_per_s.iter().map(|v| v * v).sum();
    SHARE * (squares / motion.len().max(1) as f64).sqrt()
}

/// A log's motion, the command brought forward by the delay.
fn motion(trace: &Trace, joint: u8, known: &Known, delay_s: f64) -> Option<Motion> {
    let column = trace.joint(joint)?;
    let period_s = typical_period_s(&trace.time_s);
    if period_s <= 0.0 {
        return None;
    }
    let step_rad = match known.encoder_step_rad {
        step if step > 0.0 => step,
        _ => smallest_step(&column.q_rad),
    };
    let width_s = width_for(step_rad, period_s);
    let how = Smoothing { width_s, step_s: (0.5 * width_s).max(period_s) };
    let late = (delay_s / period_s).round() as i64;
    let last = column.command_v.len() as i64 - 1;
    let delayed: Vec<f64> =
        (0..=last).map(|k| column.command_v[(k - late).clamp(0, last) as usize]).collect();
    Some(smoothed(&trace.time_s, &column.q_rad, &delayed, &how))
}

/// The smallest step that the angle makes [rad].
fn smallest_step(q_rad: &[f64]) -> f64 {
    const ROUNDING: f64 = 1e-9;
    let steps = q_rad.windows(2).map(|pair| (pair[1] - pair[0]).abs());
    let smallest = steps.filter(|&step| step > ROUNDING).fold(f64::INFINITY, f64::min);
    if smallest.is_finite() { smallest } else { 0.0 }
}

/// The Gaussian under which an encoder leaves 0.1 rad/s^2 of acceleration noise [s]: its
/// second derivative passes white rounding errors with the gain 3 T / (8 sqrt(pi) s^5).
fn width_for(encoder_step_rad: f64, period_s: f64) -> f64 {
    const NOISE_RAD_PER_S2: f64 = 0.1;
    let variance = encoder_step_rad * encoder_step_rad / 12.0;
    let gain = 8.0 * std::f64::consts::PI.sqrt() / 3.0;
    let width_s = (period_s * variance / (gain * NOISE_RAD_PER_S2.powi(2))).powf(0.2);
    width_s.clamp(3.0 * period_s, 0.06)
}

/// Why a log tells nothing of the joint, where it does not.
fn why_not(trace: &Trace, joint: u8, known: &Known) -> Option<String> {
    const FEWEST_ROWS: usize = 20;
    let Some(motion) = motion(trace, joint, known, 0.0) else {
        return Some(format!("joint {joint} is not in it"));
    };
    let slow = slow_below(&motion).max(1e-3);
    let moving: Vec<usize> = (0..motion.len())
        .filter(|&k| motion.qd_rad_per_s[k].abs() > slow && motion.measured[k])
        .collect();
    if moving.len() < FEWEST_ROWS {
        return Some(format!("joint {joint} never moved"));
    }
    if follows_position(&motion, &moving) {
        return Some(MOVED_FROM_OUTSIDE.to_owned());
    }
    None
}

/// Whether the command of a log is a mere function of the joint's position, as under
/// gravity compensation: then an outside force moved it.
pub fn is_moved_from_outside(trace: &Trace, joint: u8, known: &Known) -> bool {
    why_not(trace, joint, known).is_some_and(|why| why == MOVED_FROM_OUTSIDE)
}

/// What is said of such a log.
pub const MOVED_FROM_OUTSIDE: &str =
    "its command is a function of the position alone: an outside force moved it";

/// Whether 1, sin q and cos q explain the command all but 2 %.
fn follows_position(motion: &Motion, rows: &[usize]) -> bool {
    const SHARE: f64 = 0.02;
    let regressors = DMatrix::from_fn(rows.len(), 3, |i, column| {
        let (sine, cosine) = motion.q_rad[rows[i]].sin_cos();
        [1.0, sine, cosine][column]
    });
    let command = DVector::from_fn(rows.len(), |i, _| motion.command_v[rows[i]]);
    let Ok(solution) = regressors.clone().svd(true, true).solve(&command, 1e-9) else {
        return false;
    };
    (&command - regressors * solution).norm() < SHARE * command.norm()
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
