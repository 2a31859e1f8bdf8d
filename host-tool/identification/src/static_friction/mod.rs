//! Static friction, the Stribeck curve of eq. (10), from constant-velocity runs, section 3.1.
//!
//! The paper's method needs parts of the log in which the velocity is steady; they are
//! found in the measured motion ([`steady`]) and drawn. At a few mrad/s, though, the
//! bristles of LuGre friction, eq. (9), travel for a second before friction has its steady
//! value, or the joint sticks and slips. So the whole log is fitted at once: the measured
//! motion drives the LuGre model, whose friction together with inertia, gravity and the
//! neighbours' reaction must equal the command ([`super::one_joint::grey_box`]).
//! sigma_0 and sigma_1 come out as well, roughly; the FRF, eq. (12), gives them better.

mod breakaway;
mod constants;
mod start;
pub mod steady;

use serde::Serialize;

use super::estimate::Estimate;
use super::friction_estimates::FrictionEstimates;
use super::one_joint::grey_box::{self, Fit};
use super::one_joint::log_rows::log_rows;
use super::one_joint::parameters::{ALPHA2, BRISTLES, FRICTION, LINEAR, from_logarithms};
use super::one_joint::rows::{Rows, Term};
use super::one_joint::sliding::sliding;
use constants::{BARELY_KNOWN, FINELY};
use recordings::StepError;
use recordings::campaign::{Known, Trace};
use steady::SteadyLeg;

/// Tolerance of the searches before rows are weighted.
const ROUGHLY: f64 = 1e-3;
/// How often rows are weighted anew.
const REWEIGHTINGS: usize = 2;

/// Static friction of a joint.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StaticFriction {
    /// Joint, 1 to 3.
    pub joint: u8,
    /// Its friction; sigma_0 and sigma_1 as the reversals show them, a start for the FRF,
    /// eq. (12).
    #[serde(flatten)]
    pub friction: FrictionEstimates,
    /// The same by static friction alone, eq. (10), with bristles too stiff to be seen.
    #[serde(skip)]
    pub without_bristles: FrictionEstimates,
    /// Inertia about the joint in this posture [kg m^2].
    pub inertia_kg_m2: Estimate,
    /// Gravity torque = this * cos + [`Self::gravity_sine_nm`] * sin of the moving arm's
    /// angle against the level: q2 for joint 2, q2 + q3 for joint 3 [Nm]; `None` for joint 1.
    #[serde(rename = "gravity_cosine_Nm")]
    pub gravity_cosine_nm: Option<Estimate>,
    /// See [`Self::gravity_cosine_nm`] [Nm].
    #[serde(rename = "gravity_sine_Nm")]
    pub gravity_sine_nm: Option<Estimate>,
    /// RMS of the command that the fit leaves unexplained, means over 10 ms [V].
    #[serde(rename = "residual_rms_V")]
    pub residual_rms_v: f64,
    /// The steady parts of the legs, for the figure.
    pub legs: Vec<SteadyLeg>,
    /// Whether the search ended at a minimum.
    pub converged: bool,
}

impl StaticFriction {
    /// Points (velocity [rad/s], friction [V]) of the fitted curve (10), evenly spaced in
    /// the logarithm of the speed, for both directions.
    pub fn curve(&self) -> Vec<(f64, f64)> {
        const POINTS: usize = 120;
        let friction = self.friction.values();
        let fastest = self.legs.iter().map(|leg| leg.velocity_rad_per_s.abs()).fold(0.1, f64::max);
        let slowest = 0.2 * friction.stribeck_velocity_rad_per_s;
        let ratio = (fastest / slowest).ln() / (POINTS - 1) as f64;
        let speeds = (0..POINTS).map(|k| slowest * (ratio * k as f64).exp());
        let forward: Vec<(f64, f64)> = speeds.map(|v| (v, friction.sliding(v))).collect();
        let backward = forward.iter().rev().map(|&(v, u)| (-v, -u));
        backward.chain(forward.iter().copied()).collect()
    }
}

/// Estimates the static friction of a joint, 1 to 3, from a log in which it moved.
///
/// # Errors
/// The joint is not in the log, never moved, or never slid clearly in both directions.
pub fn identify(trace: &Trace, joint: u8, known: &Known) -> Result<StaticFriction, StepError> {
    let (rows, fit) = fit_log(trace, joint, known)?;
    if fit.parameters.iter().any(|p| !p.is_finite()) {
        let what = format!("the search did not end on {}; is its command in volts?", trace.file);
        return Err(StepError::Numerical { step: "static friction", what });
    }
    let still = without_bristles(&rows, &fit);
    Ok(result(&rows, &fit, &still, joint, known))
}

/// Bristles whose travel, at any level that joints have, no encoder shows [V/rad].
const UNSEEN_STIFFNESS_V_PER_RAD: f64 = 2e4;

/// The fit with bristles too stiff to be seen, from where LuGre's law ended.
fn without_bristles(rows: &Rows, lugre: &Fit) -> Fit {
    let free: Vec<usize> =
        (0..LINEAR + rows.terms.len()).filter(|k| !BRISTLES.contains(k)).collect();
    let mut start = lugre.parameters.clone();
    start[BRISTLES[0]] = UNSEEN_STIFFNESS_V_PER_RAD.ln();
    start[BRISTLES[1]] = start[ALPHA2];
    let fit = grey_box::fit(&rows.data, start, &free, FINELY);
    with_method_error(breakaway::within_what_rows_show(rows, fit, &free))
}

/// Points of the grid from which a search may begin.
const STARTS: usize = 6;

/// Whether the Stribeck curve describes what happens at slow speeds. A search can also end
/// where it bends the viscous friction of fast ones.
fn is_stribeck(fit: &Fit) -> bool {
    const FASTEST_RAD_PER_S: f64 = 0.1;
    from_logarithms(&fit.parameters.as_slice()[..FRICTION]).stribeck_velocity_rad_per_s
        < FASTEST_RAD_PER_S
}

/// A log's rows and the best fit to them.
///
/// # Errors
/// As [`identify`].
pub fn fit_log(trace: &Trace, joint: u8, known: &Known) -> Result<(Rows, Fit), StepError> {
    let rows = log_rows(trace, joint, known)?;
    let unusable = || StepError::Unusable {
        file: trace.file.clone(),
        what: format!(
            "joint {joint} does not slide above 0.02 rad/s in both directions; record legs both ways"
        ),
    };
    let sliding = sliding(&rows).ok_or_else(unusable)?;
    let free: Vec<usize> = (0..LINEAR + rows.terms.len()).collect();
    let mut rows = rows;
    let rough = |start| grey_box::fit(&rows.data, start, &free, ROUGHLY);
    let mut fits = start::grid(&rows, &sliding).into_iter().take(STARTS).map(rough);
    let first = fits.next().ok_or_else(unusable)?;
    let mut best =
        if is_stribeck(&first) { first } else { fits.find(is_stribeck).unwrap_or(first) };
    for _ in 0..REWEIGHTINGS {
        rows.data.weight = grey_box::weights_from(&best, &rows.data.weight);
        best = grey_box::fit(&rows.data, best.parameters, &free, FINELY);
    }
    let best = breakaway::within_what_rows_show(&rows, best, &free);
    Ok((rows, with_method_error(best)))
}

fn result(rows: &Rows, fit: &Fit, still: &Fit, joint: u8, known: &Known) -> StaticFriction {
    let k_t = known.torque_constant(joint);
    let torque = |term: Term| {
        let parameter = LINEAR + rows.column(term)?;
        Some(Estimate::new(k_t * fit.parameters[parameter], k_t * fit.standard_error(parameter)))
    };
    let mut friction =
        FrictionEstimates::from_logarithms(fit.parameters.as_slice(), &fit.covariance);
    for estimate in [
        &mut friction.alpha1_v,
        &mut friction.breakaway_v,
        &mut friction.stribeck_velocity_rad_per_s,
    ] {
        note_missing_low_speed(fit, estimate);
    }
    StaticFriction {
        joint,
        legs: steady::legs(rows, fit, &fit.friction()),
        friction,
        without_bristles: FrictionEstimates::from_logarithms(
            still.parameters.as_slice(),
            &still.covariance,
        ),
        inertia_kg_m2: torque(Term::Inertia).unwrap_or_else(|| Estimate::new(f64::NAN, f64::NAN)),
        gravity_cosine_nm: torque(Term::GravityCosine),
        gravity_sine_nm: torque(Term::GravitySine),
        residual_rms_v: fit.rms_v,
        converged: fit.converged,
    }
}

/// Relative errors (rms) that the method leaves whatever the data: velocity jitter taken as
/// two values, motion averaged over 2 ms. Measured on simulated robots, where they
/// stand out because nothing else is wrong; in the order of the friction's logarithms.
const METHOD_ERROR: [f64; 6] = [3e-4, 6e-3, 2.5e-2, 5e-4, 5e-3, 0.15];

/// The fit's covariance with the method's own errors added.
fn with_method_error(fit: Fit) -> Fit {
    let mut fit = fit;
    for (k, error) in METHOD_ERROR.into_iter().enumerate() {
        fit.covariance[(k, k)] += error * error;
    }
    if fit.standard_error(2) > BARELY_KNOWN {
        // Reversals alone shape a breakaway level, but of a curve that nobody has seen.
        fit.covariance[(1, 1)] += UNSEEN_BREAKAWAY * UNSEEN_BREAKAWAY;
    }
    fit
}

/// Relative error of the breakaway level then.
const UNSEEN_BREAKAWAY: f64 = 0.3;

/// Notes where the log holds too little of the Stribeck curve.
fn note_missing_low_speed(fit: &Fit, estimate: &mut Estimate) {
    if fit.standard_error(2) < BARELY_KNOWN {
        return;
    }
    let note = "the log has too little sliding at speeds near v_s to tell the Stribeck curve";
    estimate.note = Some(note.into());
}
