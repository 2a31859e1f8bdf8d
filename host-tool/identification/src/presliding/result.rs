//! Estimates, intervals, remarks, and the FRF for Fig. 4.

use serde::Serialize;

use super::fit::Fitted;
use super::prior::{Bristles, Prior, Settings};
use super::record::Record;
use crate::estimate::Estimate;

/// Pre-sliding friction of one joint.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Presliding {
    /// Joint, 1 to 3.
    pub joint: u8,
    /// The log.
    pub file: String,
    /// Stiffness sigma_0 [V/rad].
    #[serde(rename = "sigma0_V_per_rad")]
    pub sigma0_v_per_rad: Estimate,
    /// Damping sigma_1 [V s/rad].
    #[serde(rename = "sigma1_V_s_per_rad")]
    pub sigma1_v_s_per_rad: Estimate,
    /// The band of the fit [Hz].
    pub band_hz: [f64; 2],
    /// RMS of the noise [V].
    #[serde(rename = "command_rms_V")]
    pub command_rms_v: f64,
    /// RMS of the motion that follows the commands [rad].
    pub motion_rms_rad: f64,
    /// The same in encoder steps; absent where the step is unknown.
    pub motion_rms_encoder_steps: Option<f64>,
    /// Segments averaged.
    pub segments: usize,
    /// Mean square of the fit's residual over what its spectrum predicts; 1 is perfect.
    pub misfit: f64,
    /// Rate lambda at which the bristles creep under the noise [1/s].
    pub creep_per_s: f64,
    /// What the reader must know.
    pub remarks: Vec<String>,
    /// The FRF, for Fig. 4.
    #[serde(skip)]
    pub frf: Vec<FrfPoint>,
}

impl Presliding {
    /// The bristles for the fits of the neighbours, with least errors.
    pub(super) fn bristles(&self) -> Bristles {
        let relative =
            |estimate: &Estimate, least: f64| (estimate.standard_error / estimate.value).max(least);
        Bristles {
            sigma0_v_per_rad: self.sigma0_v_per_rad.value,
            sigma0_relative_error: relative(&self.sigma0_v_per_rad, 0.03),
            sigma1_v_s_per_rad: self.sigma1_v_s_per_rad.value,
            sigma1_relative_error: relative(&self.sigma1_v_s_per_rad, 0.08),
        }
    }
}

/// One frequency of the FRF.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FrfPoint {
    /// Frequency [Hz].
    pub frequency_hz: f64,
    /// Measured magnitude, H1 or by the reference [rad/V].
    #[serde(rename = "measured_rad_per_V")]
    pub measured_rad_per_v: f64,
    /// Measured phase [rad], within +-pi.
    pub measured_phase_rad: f64,
    /// Magnitude of the fit [rad/V].
    #[serde(rename = "fitted_rad_per_V")]
    pub fitted_rad_per_v: f64,
    /// Phase of the fit [rad], within +-pi.
    pub fitted_phase_rad: f64,
    /// Ordinary coherence of noise and angle.
    pub coherence: f64,
    /// Multiple coherence of all commands and the angle.
    pub multiple_coherence: f64,
}

/// Above this part of breakaway the joint does not stay in its pre-sliding range.
const LARGEST_PART_OF_BREAKAWAY: f64 = 0.2;
/// Further relative errors of sigma_0 and sigma_1 without base parameters: gravity's
/// stiffness is then part of sigma_0, and the couplings are known only from one joint.
const UNKNOWN_BODY: [f64; 2] = [0.03, 0.12];
/// Intervals wider than this, relative, carry little.
const WIDE: f64 = 0.15;

/// Puts estimates, intervals and remarks together.
pub fn conclude(
    record: &Record,
    fitted: &Fitted,
    prior: &Prior,
    settings: &Settings,
) -> Presliding {
    let own = fitted.robot.friction[record.excited];
    let steps =
        (record.encoder_step_rad > 0.0).then(|| fitted.motion_rms_rad / record.encoder_step_rad);
    let coarse = steps.map_or(0.0, |steps| quantisation_error(record, steps));
    let gravity = gravity_error(record, fitted);
    let sigma0_error =
        root_sum_square(&[fitted.relative_error[0], settings.sigma0_model_error, coarse, gravity]);
    let body = if fitted.body_known { 0.0 } else { UNKNOWN_BODY[1] };
    let viscous = viscous_error(record, prior) / own.sigma1_v_s_per_rad;
    let sigma1_error = root_sum_square(&[
        fitted.relative_error[1],
        settings.sigma1_model_error,
        coarse,
        viscous,
        body,
    ]);
    let remarks = remarks(record, fitted, prior, steps);
    let note = (!remarks.is_empty()).then(|| remarks.join("; "));
    let with_note = |estimate: Estimate| match &note {
        Some(note) => estimate.with_note(note.clone()),
        None => estimate,
    };
    let hz = |bin: Option<&usize>| bin.map_or(f64::NAN, |&bin| record.spectra.frequency_hz[bin]);
    Presliding {
        joint: record.excited as u8 + 1,
        file: record.file.clone(),
        sigma0_v_per_rad: with_note(positive(own.sigma0_v_per_rad, sigma0_error)),
        sigma1_v_s_per_rad: with_note(positive(own.sigma1_v_s_per_rad, sigma1_error)),
        band_hz: [hz(fitted.bins.first()), hz(fitted.bins.last())],
        command_rms_v: record.command_rms_v,
        motion_rms_rad: fitted.motion_rms_rad,
        motion_rms_encoder_steps: steps,
        segments: record.segments,
        misfit: fitted.misfit,
        creep_per_s: own.creep_per_s,
        remarks,
        frf: frf(record, fitted),
    }
}

/// A positive value whose logarithm is normally distributed.
fn positive(value: f64, relative_error: f64) -> Estimate {
    let factor = (1.959_964 * relative_error).exp();
    let mut estimate = Estimate::new(value, value * relative_error);
    estimate.interval = [value / factor, value * factor];
    estimate
}

fn root_sum_square(parts: &[f64]) -> f64 {
    parts.iter().map(|part| part * part).sum::<f64>().sqrt()
}

/// Relative error of the FRF's gain from an encoder that is too coarse.
///
/// A normally distributed motion of `steps` RMS about a place m (in steps) is read with
/// the gain 1 + 2 cos(2 pi m) exp(-2 pi^2 steps^2); the drift of m averages that.
fn quantisation_error(record: &Record, steps: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    let count = record.positions_in_steps.len().max(1) as f64;
    let sum = |f: fn(f64) -> f64| record.positions_in_steps.iter().map(|m| f(TAU * m)).sum::<f64>();
    let coherent = sum(f64::cos).hypot(sum(f64::sin)) / count;
    2.0 * coherent.max(count.sqrt().recip()) * (-2.0 * PI * PI * steps * steps).exp()
}

/// Relative error of sigma_0 from gravity's stiffness and from couplings in the dark.
fn gravity_error(record: &Record, fitted: &Fitted) -> f64 {
    if !fitted.body_known {
        return UNKNOWN_BODY[0];
    }
    let (i, robot) = (record.excited, &fitted.robot);
    let stiffness = robot.gravity_nm_per_rad[i][i] / robot.torque_constant_nm_per_v[i];
    (stiffness * fitted.inertia_error / robot.friction[i].sigma0_v_per_rad).abs()
}

/// Standard error of alpha_2 [V s/rad].
fn viscous_error(record: &Record, prior: &Prior) -> f64 {
    let sliding = prior.sliding[record.excited].as_ref();
    sliding.map_or(super::prior_distribution::TYPICAL_VISCOUS_V_S_PER_RAD, |s| {
        s.alpha2_v_s_per_rad.standard_error
    })
}

fn remarks(record: &Record, fitted: &Fitted, prior: &Prior, steps: Option<f64>) -> Vec<String> {
    let mut remarks = Vec::new();
    let joint = record.excited + 1;
    let wide = fitted.relative_error[0].max(0.5 * fitted.relative_error[1]) * 1.96 > WIDE;
    if let Some(steps) = steps.filter(|&steps| steps < 1.0) {
        let verdict = if wide || steps < 0.3 {
            "the data cannot carry the estimate"
        } else {
            "only averaging carries the estimate"
        };
        remarks.push(format!("joint {joint} moves {steps:.2} encoder steps RMS: {verdict}"));
    } else if wide {
        remarks.push("the data carry the estimate poorly: raise the noise or record longer".into());
    }
    if fitted.misfit > 1.5 {
        remarks.push(format!("the fit leaves {:.1} times the expected residual", fitted.misfit));
    }
    if !fitted.body_known {
        let what = "couplings are guessed, and sigma0 includes the gravity stiffness";
        remarks.push(format!("base parameters unknown: {what}"));
    }
    let own = fitted.robot.friction[record.excited];
    if let Some(sliding) = prior.sliding[record.excited].as_ref() {
        let breakaway_v = sliding.alpha0_v.value + sliding.alpha1_v.value;
        if fitted.motion_rms_rad * own.sigma0_v_per_rad > LARGEST_PART_OF_BREAKAWAY * breakaway_v {
            remarks.push("the noise leaves the pre-sliding range: lower it".into());
        }
    } else {
        remarks.push("sliding friction unknown: creep and alpha2 are guesses".into());
    }
    remarks
}

fn frf(record: &Record, fitted: &Fitted) -> Vec<FrfPoint> {
    let first = 1;
    (first..record.spectra.bins())
        .filter_map(|bin| {
            let frequency_hz = record.spectra.frequency_hz[bin];
            let model = fitted.robot.frf(frequency_hz, record.period_s)?;
            let command = |joint| record.command_by_instrument(bin, joint);
            let excited = record.excited;
            let angle: nalgebra::Complex<f64> =
                (0..3).map(|joint| model[(excited, joint)] * command(joint)).sum();
            let fitted = angle / command(excited);
            let measured = record.frf(bin);
            Some(FrfPoint {
                frequency_hz,
                measured_rad_per_v: measured.norm(),
                measured_phase_rad: measured.arg(),
                fitted_rad_per_v: fitted.norm(),
                fitted_phase_rad: fitted.arg(),
                coherence: record.coherence(bin),
                multiple_coherence: record.multiple_coherence(bin),
            })
        })
        .collect()
}
