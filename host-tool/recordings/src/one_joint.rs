//! Logs of a rig of one joint: the smoothed motion, and whether its motor drove it.

use nalgebra::{DMatrix, DVector};

use crate::campaign::{Known, Trace};
use crate::smoothed::{SmoothedMotion, Smoothing, smoothed, typical_period_s};

/// Why a log does not determine the joint's parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NotDriven {
    /// The log lacks the joint.
    #[error("joint {0} is not in it")]
    Missing(u8),
    /// The joint stands still.
    #[error("joint {0} never moved")]
    AtRest(u8),
    /// The command is a mere function of the position, as under gravity compensation.
    #[error("its command is a function of the position alone: an outside force moved it")]
    ExternalForce,
}

/// Whether the joint moves by its own motor.
///
/// # Errors
/// It does not, or is not in the log.
pub fn check_driven(trace: &Trace, joint: u8, known: &Known) -> Result<(), NotDriven> {
    const FEWEST_ROWS: usize = 20;
    let motion = motion(trace, joint, known, 0.0).ok_or(NotDriven::Missing(joint))?;
    let slow = slow_below(&motion).max(1e-3);
    let moving: Vec<usize> = (0..motion.len())
        .filter(|&k| motion.qd_rad_per_s[k].abs() > slow && motion.measured[k])
        .collect();
    if moving.len() < FEWEST_ROWS {
        return Err(NotDriven::AtRest(joint));
    }
    if follows_position(&motion, &moving) { Err(NotDriven::ExternalForce) } else { Ok(()) }
}

/// A log's motion, the command brought forward by a delay; `None` without the joint.
pub fn motion(trace: &Trace, joint: u8, known: &Known, delay_s: f64) -> Option<SmoothedMotion> {
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

/// Below this the sign of the velocity is not sure [rad/s].
pub fn slow_below(motion: &SmoothedMotion) -> f64 {
    const SHARE: f64 = 0.05;
    let squares: f64 = motion.qd_rad_per_s.iter().map(|v| v * v).sum();
    SHARE * (squares / motion.len().max(1) as f64).sqrt()
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

/// Whether 1, sin q and cos q explain the command all but 2 %.
fn follows_position(motion: &SmoothedMotion, rows: &[usize]) -> bool {
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
