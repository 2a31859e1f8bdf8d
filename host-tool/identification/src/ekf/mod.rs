//! Static friction, inertia and gravity of a joint by the augmented Kalman filter,
//! section 3.1 and the pendulum with friction, eq. (11).
//!
//! States are q, qd, alpha_0, alpha_1 (as alpha_0 + alpha_1), v_s, alpha_2, J and l, as
//! in the paper, all but q and qd by logarithms or where sign is free directly; beyond
//! the paper the deflection z with sigma_0 and sigma_1, the phase of gravity, and the
//! coupling with the neighbours' measured acceleration. With z the friction is LuGre's,
//! eq. (9), not its steady value, eq. (10): at a reversal the steady value jumps by 0.7 V
//! within a tick, within which the joint passes the Stribeck velocity, and its
//! linearisation is useless; LuGre friction changes over the bristles' travel, tens of
//! ticks, over which the linearisation holds.
//!
//! Tuning is from the data: measurement noise is the encoder step's, process noise is the
//! voltage noise that makes the innovations most likely. Passes begin from the last
//! one's estimates with a variance that shrinks from pass to pass.

pub mod filter;
mod result;
mod start;

use super::one_joint::innovations::{Innovations, most_likely_noise};
use super::one_joint::log_rows::log_rows;
use super::one_joint::noise::NoiseVariances;
use super::one_joint::parameters::FRICTION;
use super::one_joint::samples::{Samples, samples};
use filter::{FilterPass, ParameterEstimate};
use recordings::StepError;
use recordings::campaign::{Known, Trace};
pub use result::{EkfPass, EkfResult};
pub use start::Start;

/// How many passes the filter makes.
pub const PASSES: usize = 10;

/// How far off, relatively, the parameters may be at a pass's beginning.
fn spread(pass: usize) -> f64 {
    const FIRST: f64 = 0.3;
    const SHRINKAGE: f64 = 0.6;
    const LEAST: f64 = 0.02;
    (FIRST * SHRINKAGE.powi(pass as i32)).max(LEAST)
}

/// Identifies joint `joint`, 1 to 3, from a log in which it alone was driven.
///
/// # Errors
/// The joint is not in the log, never moved, or the filter lost the motion.
pub fn identify(
    trace: &Trace,
    joint: u8,
    known: &Known,
    start: &Start,
) -> Result<EkfResult, StepError> {
    let rows = log_rows(trace, joint, known)?;
    let missing = || StepError::Unusable {
        file: trace.file.clone(),
        what: format!("joint {joint} or a neighbour is missing; record all joints"),
    };
    let samples = samples(trace, joint, &rows.terms, known).ok_or_else(missing)?;
    let expected = NoiseVariances::expected(known);
    let mut noise = NoiseVariances { command_v2: FIRST_NOISE_V * FIRST_NOISE_V, ..expected };
    let mut parameters = start.parameters(&rows);
    let mut history = Vec::with_capacity(PASSES);
    let mut last = None;
    for number in 0..PASSES {
        if number == 3 || number == 6 {
            noise = most_likely_noise(&representative(&samples), &parameters, noise);
        }
        let pass = pass_on_track(&samples, parameters, &noise, spread(number));
        let pass = pass.ok_or_else(|| lost(trace))?;
        parameters = pass.estimate.parameters.clone();
        history.push(EkfPass::of(number + 1, &pass, &noise, known.torque_constant(joint), &rows));
        last = Some(pass);
    }
    let innovations = Innovations::of(&samples, &parameters, &noise);
    let states = last.map_or_else(Vec::new, |pass| pass.states);
    let k_t = known.torque_constant(joint);
    Ok(result::assembled(&rows, &parameters, &innovations, history, states, noise, joint, k_t))
}

/// Voltage noise before it is tuned: rather too much, so that the encoder leads [V].
const FIRST_NOISE_V: f64 = 0.01;

/// Standard deviations at a pass's beginning: relative, but for small linear factors.
fn deviations(parameters: &[f64], spread: f64) -> Vec<f64> {
    const LEAST_FACTOR: f64 = 0.02;
    let of = |(k, value): (usize, &f64)| match k {
        _ if k < FRICTION => spread,
        FRICTION => spread * value.abs(),
        _ => spread * value.abs().max(LEAST_FACTOR),
    };
    parameters.iter().enumerate().map(of).collect()
}

/// Ten seconds past the middle: enough for the noise.
fn representative(samples: &Samples) -> Samples {
    const SPAN_S: f64 = 10.0;
    let (first, last) = (samples.time_s[0], samples.time_s[samples.time_s.len() - 1]);
    let from_s = first + 0.6 * (last - first - SPAN_S).max(0.0);
    let from = samples.time_s.partition_point(|&t| t < from_s);
    let to = samples.time_s.partition_point(|&t| t < from_s + SPAN_S);
    samples.part(from, to)
}

/// A pass that follows the motion: where the filter, still unsure of its parameters, takes
/// too large a step at a reversal and loses the motion, the pass is made again from the
/// same estimates with less spread.
fn pass_on_track(
    samples: &Samples,
    parameters: Vec<f64>,
    noise: &NoiseVariances,
    spread: f64,
) -> Option<FilterPass> {
    const SPREADS: [f64; 5] = [1.0, 0.4, 0.16, 0.06, 0.02];
    SPREADS.into_iter().find_map(|share| {
        let deviation = deviations(&parameters, share * spread);
        let start = ParameterEstimate { parameters: parameters.clone(), deviation };
        let pass = filter::run(samples, &start, noise);
        is_on_track(&pass, noise).then_some(pass)
    })
}

/// Whether all is finite, inertia positive, and innovations are of the encoder's size.
fn is_on_track(pass: &FilterPass, noise: &NoiseVariances) -> bool {
    const DEVIATIONS: f64 = 100.0;
    let parameters = &pass.estimate.parameters;
    let finite =
        pass.negative_log_likelihood.is_finite() && parameters.iter().all(|p| p.is_finite());
    let lost_rad = DEVIATIONS * noise.measurement_rad2.sqrt();
    finite && parameters[FRICTION] > 0.0 && pass.innovation_rms_rad < lost_rad
}

fn lost(trace: &Trace) -> StepError {
    StepError::Numerical {
        step: "EKF",
        what: format!(
            "the filter lost the motion of {}; check that its command is in volts and that \
             the torque constant is right, or give a better start",
            trace.file
        ),
    }
}
