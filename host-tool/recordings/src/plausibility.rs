//! Plausibility of a log: units, joints, encoders, commands, gaps.

use super::campaign::{JointTrace, Known, Trace};
use crate::StepError;
use files::Experiment;
use signal::rms;

/// Faster than any joint of this kind turns [rad/s].
const FASTEST_RAD_PER_S: f64 = 60.0;
/// A sensor that reads the same for so long in the middle of a motion is stuck [s].
const STUCK_S: f64 = 0.3;
/// Fast enough that a joint cannot stop from one sample to the next [rad/s].
const MOVING_RAD_PER_S: f64 = 0.5;
/// A command beyond the limit by this factor is in another unit.
const WRONG_UNIT: f64 = 3.0;
/// More than this share of commands at the limit spoils a log.
const MOST_AT_LIMIT: f64 = 0.05;

/// Remarks on a log that can be used.
///
/// # Errors
/// The log cannot be used: its units, its columns or a sensor are wrong.
pub fn examine(trace: &Trace, known: &Known) -> Result<Vec<String>, StepError> {
    let unusable = |what: String| StepError::Unusable { file: trace.file.clone(), what };
    for joint in &trace.joints {
        // First, because what comes after a stuck encoder jumps.
        check_encoder(trace, joint).map_err(unusable)?;
        check_units(trace, joint, known).map_err(unusable)?;
    }
    check_order(trace).map_err(unusable)?;
    let mut remarks: Vec<String> =
        trace.joints.iter().filter_map(|joint| at_the_limit(joint, known)).collect();
    remarks.extend(gaps(trace));
    Ok(remarks.into_iter().map(|remark| format!("{}: {remark}", trace.file)).collect())
}

fn check_units(trace: &Trace, joint: &JointTrace, known: &Known) -> Result<(), String> {
    let number = joint.number;
    let peak = joint.command_v.iter().fold(0.0_f64, |peak, u| peak.max(u.abs()));
    if peak > WRONG_UNIT * known.command_limit_v {
        return Err(format!(
            "u{number}_V reaches {peak:.3}, above command_limit_V = {}; is the column in volts?",
            known.command_limit_v
        ));
    }
    // Over 20 ms, so that an encoder's step is no speed.
    let span = ((0.02 / trace.period_s).round() as usize).max(1);
    let speeds = joint.q_rad.windows(span + 1).zip(trace.time_s.windows(span + 1));
    let fastest =
        speeds.map(|(q, t)| (q[span] - q[0]).abs() / (t[span] - t[0])).fold(0.0_f64, f64::max);
    if fastest > FASTEST_RAD_PER_S {
        return Err(format!(
            "joint {number} turns at {fastest:.0} rad/s; is q{number} in radians or counts, and \
             encoder_counts_per_rev right?"
        ));
    }
    Ok(())
}

/// A joint that stands still from one sample to the next in full motion, and stays so.
fn check_encoder(trace: &Trace, joint: &JointTrace) -> Result<(), String> {
    let run = ((STUCK_S / trace.period_s).round() as usize).max(2);
    let before = ((0.01 / trace.period_s).round() as usize).max(1);
    let q = &joint.q_rad;
    for start in before..q.len().saturating_sub(run) {
        let speed = (q[start] - q[start - before]).abs() / (before as f64 * trace.period_s);
        if speed > MOVING_RAD_PER_S && q[start..start + run].iter().all(|&x| x == q[start]) {
            return Err(format!(
                "q{} stands still from {:.3} s on in the middle of a motion; the encoder is stuck",
                joint.number, trace.time_s[start]
            ));
        }
    }
    Ok(())
}

/// A joint that follows another joint's reference better than its own.
fn check_order(trace: &Trace) -> Result<(), String> {
    let moving = matches!(
        trace.experiment,
        Experiment::Excitation | Experiment::Slow | Experiment::Task | Experiment::DrivenNoise
    );
    if !moving {
        return Ok(());
    }
    for joint in &trace.joints {
        let Some(own) = joint.reference_rad.as_ref() else { continue };
        for other in trace.joints.iter().filter(|other| other.number != joint.number) {
            let Some(reference) = other.reference_rad.as_ref() else { continue };
            let to_own = rms_difference(&joint.q_rad, own);
            if to_own > 0.5 && rms_difference(&joint.q_rad, reference) < 0.2 * to_own {
                return Err(format!(
                    "joint {} follows the reference of joint {}; are the columns swapped?",
                    joint.number, other.number
                ));
            }
        }
    }
    Ok(())
}

/// Root mean square of a difference.
fn rms_difference(a: &[f64], b: &[f64]) -> f64 {
    rms(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<f64>>())
}

fn at_the_limit(joint: &JointTrace, known: &Known) -> Option<String> {
    let peak_v = joint.command_v.iter().fold(0.0_f64, |peak, u| peak.max(u.abs()));
    if peak_v > 1.001 * known.command_limit_v {
        let (number, limit_v) = (joint.number, known.command_limit_v);
        return Some(format!("u{number}_V reaches {peak_v:.3}, above command_limit_V = {limit_v}"));
    }
    let edge_v = known.command_limit_v - 1.5 * known.command_step_v;
    let cut = joint.command_v.iter().filter(|u| u.abs() >= edge_v).count();
    let share = cut as f64 / joint.command_v.len().max(1) as f64;
    (share > MOST_AT_LIMIT).then(|| {
        format!(
            "joint {} is at its limit for {:.0} % of the time; record it with less motion",
            joint.number,
            100.0 * share
        )
    })
}

fn gaps(trace: &Trace) -> Option<String> {
    let late = |w: &&[f64]| w[1] - w[0] > 1.5 * trace.period_s;
    let missing: f64 =
        trace.time_s.windows(2).filter(late).map(|w| (w[1] - w[0]) / trace.period_s - 1.0).sum();
    let share = missing / (missing + trace.len() as f64);
    (share > 1e-3)
        .then(|| format!("{:.1} % of the samples are missing; they are passed over", 100.0 * share))
}
