//! The filter's estimates with their standard errors.

use model::Friction;
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use super::filter::FilterPass;
use crate::estimate::Estimate;
use crate::friction_estimates::FrictionEstimates;
use crate::one_joint::dynamics::State;
use crate::one_joint::innovations::Innovations;
use crate::one_joint::noise::NoiseVariances;
use crate::one_joint::parameters::{FRICTION, from_logarithms};
use crate::one_joint::rows::{Rows, Term};

/// Estimates at the end of one pass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EkfPass {
    /// 1 for the first.
    pub number: usize,
    /// Friction.
    pub friction: Friction<f64>,
    /// Inertia [kg m^2].
    pub inertia_kg_m2: f64,
    /// Gravity torque at the level [Nm].
    #[serde(rename = "gravity_torque_Nm")]
    pub gravity_torque_nm: f64,
    /// RMS innovation [rad].
    pub innovation_rms_rad: f64,
    /// Mean squared innovation over its expected variance: 1 where the tuning is right.
    pub normalised_innovation: f64,
    /// Voltage noise that the filter presumed [V].
    #[serde(rename = "voltage_noise_V")]
    pub voltage_noise_v: f64,
}

impl EkfPass {
    pub(super) fn of(
        number: usize,
        pass: &FilterPass,
        noise: &NoiseVariances,
        k_t: f64,
        rows: &Rows,
    ) -> Self {
        let p = &pass.estimate.parameters;
        let gravity = gravity(rows, p).map_or(0.0, |(size, _)| size);
        Self {
            number,
            friction: from_logarithms(p),
            inertia_kg_m2: k_t * p[FRICTION],
            gravity_torque_nm: k_t * gravity,
            innovation_rms_rad: pass.innovation_rms_rad,
            normalised_innovation: pass.normalised,
            voltage_noise_v: noise.command_v2.sqrt(),
        }
    }
}

/// The result of the augmented filter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EkfResult {
    /// Joint, 1 to 3.
    pub joint: u8,
    /// Its friction.
    #[serde(flatten)]
    pub friction: FrictionEstimates,
    /// Inertia J of eq. (11) [kg m^2].
    pub inertia_kg_m2: Estimate,
    /// Gravity torque l of eq. (11) [Nm]; `None` for joint 1.
    #[serde(rename = "gravity_torque_Nm")]
    pub gravity_torque_nm: Option<Estimate>,
    /// Phase p of gravity: torque = l cos(angle against the level + p) [rad]; for joint 3
    /// atan2(my3r, mx3r).
    pub gravity_phase_rad: Option<Estimate>,
    /// Every pass, the first one first.
    pub history: Vec<EkfPass>,
    /// Whether the last pass and the likelihood's own slope moved the estimates by less
    /// than their standard errors.
    pub converged: bool,
    /// Filtered motion of the last pass, at every sample.
    #[serde(skip)]
    pub motion: Vec<State>,
    /// Noises that the last pass presumed.
    pub noise: NoiseVariances,
    /// Correlation of the innovations from tick to tick: 0 where they are white.
    pub innovation_correlation: f64,
}

/// Relative errors (rms) that the method leaves whatever the data: neighbours' motion above
/// the bandwidth of their encoders, ticks of finite length. Measured on simulated robots; in
/// the order of friction's logarithms, then inertia and gravity.
const METHOD_ERROR: [f64; FRICTION] = [3e-4, 2.5e-2, 2e-2, 8e-4, 2e-3, 2e-2];
const INERTIA_ERROR: f64 = 2e-3;
const GRAVITY_ERROR: f64 = 5e-4;

#[allow(clippy::too_many_arguments)] // Pieces of one result, gathered once.
pub(super) fn assembled(
    rows: &Rows,
    parameters: &[f64],
    innovations: &Innovations,
    history: Vec<EkfPass>,
    motion: Vec<State>,
    noise: NoiseVariances,
    joint: u8,
    k_t: f64,
) -> EkfResult {
    let mut covariance = innovations.covariance();
    let step = innovations.newton_step();
    for (k, error) in METHOD_ERROR.into_iter().enumerate() {
        covariance[(k, k)] += error * error;
    }
    covariance[(FRICTION, FRICTION)] += (INERTIA_ERROR * parameters[FRICTION]).powi(2);
    let converged = settled(&history) && small(step, &covariance);
    let friction = FrictionEstimates::from_logarithms(parameters, &covariance);
    let gravity = gravity_estimates(rows, parameters, &covariance);
    EkfResult {
        joint,
        friction: friction.map(|estimate| noted(estimate, converged)),
        inertia_kg_m2: noted(
            Estimate::new(
                k_t * parameters[FRICTION],
                k_t * covariance[(FRICTION, FRICTION)].sqrt(),
            ),
            converged,
        ),
        gravity_torque_nm: gravity
            .map(|([l, error], _)| noted(Estimate::new(k_t * l, k_t * error), converged)),
        gravity_phase_rad: gravity
            .map(|(_, [phase, error])| noted(Estimate::new(phase, error), converged)),
        history,
        converged,
        motion,
        noise,
        innovation_correlation: innovations.correlation(),
    }
}

/// Whether the last two passes agree to a percent in what slides.
fn settled(history: &[EkfPass]) -> bool {
    const SHARE: f64 = 0.01;
    let [.., before, last] = history else { return false };
    let close = |a: f64, b: f64| (a - b).abs() <= SHARE * b.abs();
    close(before.friction.alpha0_v, last.friction.alpha0_v)
        && close(before.friction.alpha2_v_s_per_rad, last.friction.alpha2_v_s_per_rad)
        && close(before.inertia_kg_m2, last.inertia_kg_m2)
}

/// Whether a step is within two standard errors.
fn small(step: Option<DVector<f64>>, covariance: &DMatrix<f64>) -> bool {
    let Some(step) = step else { return false };
    (0..=FRICTION).all(|k| step[k].abs() <= 2.0 * covariance[(k, k)].sqrt())
}

fn noted(estimate: Estimate, converged: bool) -> Estimate {
    if converged { estimate } else { estimate.with_note("the filter has not converged") }
}

/// Parameter indices of gravity's cosine and sine.
fn gravity_indices(rows: &Rows) -> Option<(usize, usize)> {
    let index = |term: Term| rows.column(term).map(|column| FRICTION + column);
    Some((index(Term::GravityCosine)?, index(Term::GravitySine)?))
}

/// Size [V] and phase [rad] of gravity.
fn gravity(rows: &Rows, parameters: &[f64]) -> Option<(f64, f64)> {
    let (cosine, sine) = gravity_indices(rows)?;
    let (a, b) = (parameters[cosine], parameters[sine]);
    Some((a.hypot(b), (-b).atan2(a)))
}

/// Size and phase of gravity, each with its standard error.
fn gravity_estimates(
    rows: &Rows,
    parameters: &[f64],
    covariance: &DMatrix<f64>,
) -> Option<([f64; 2], [f64; 2])> {
    let (i, j) = gravity_indices(rows)?;
    let (size, phase) = gravity(rows, parameters)?;
    let (ca, cb) = (parameters[i] / size, parameters[j] / size);
    let along = ca * ca * covariance[(i, i)]
        + 2.0 * ca * cb * covariance[(i, j)]
        + cb * cb * covariance[(j, j)];
    let across = cb * cb * covariance[(i, i)] - 2.0 * ca * cb * covariance[(i, j)]
        + ca * ca * covariance[(j, j)];
    let floor = GRAVITY_ERROR * size;
    let along = (along.max(0.0) + floor * floor).sqrt();
    let across = (across.max(0.0) + floor * floor).sqrt();
    Some(([size, along], [phase, across / size]))
}
