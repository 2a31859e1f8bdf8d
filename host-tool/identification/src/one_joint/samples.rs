//! A log as samples of one joint, with what its neighbours do.

use super::innovations::{Noise, Samples};
use super::motion::{Smoothing, smoothed};
use super::rows::Term;
use super::tick::Regressor;
use model::HANGING_RAD;
use recordings::campaign::{Known, Trace};

/// The samples of a log, for linear terms of which the first is inertia; `None` where
/// the joint is not in the log.
pub fn samples(trace: &Trace, joint: u8, terms: &[Term], known: &Known) -> Option<Samples> {
    let moving = trace.joint(joint)?;
    let neighbour = |n: u8| acceleration(trace, n, known);
    let mut signals: Vec<Vec<f64>> = Vec::new();
    let mut regressors = Vec::new();
    for term in terms {
        let signal = match *term {
            Term::Inertia => continue,
            Term::GravityCosine => {
                regressors.push(Regressor::Cosine);
                continue;
            }
            Term::GravitySine => {
                regressors.push(Regressor::Sine);
                continue;
            }
            Term::Neighbour(n) => neighbour(n)?,
            Term::GiveWay => {
                let third = &trace.joint(3)?.q_rad;
                let held_rad = third.iter().sum::<f64>() / third.len().max(1) as f64;
                let by_sine = third.iter().zip(&moving.q_rad);
                by_sine.map(|(q3, q2)| (held_rad - q3) * q2.sin()).collect()
            }
            Term::NeighbourCosine(n) => {
                let by_cosine = neighbour(n)?.into_iter().zip(&moving.q_rad);
                by_cosine.map(|(qdd, q)| qdd * q.cos()).collect()
            }
        };
        regressors.push(Regressor::Signal(signals.len()));
        signals.push(signal);
    }
    let by_sample = match signals.is_empty() {
        true => Vec::new(),
        false => (0..trace.len()).map(|k| signals.iter().map(|s| s[k]).collect()).collect(),
    };
    let carried_rad = match (joint, trace.joint(2)) {
        (3, Some(second)) => second.q_rad.clone(),
        (3, None) => vec![HANGING_RAD[1]; trace.len()],
        _ => Vec::new(),
    };
    Some(Samples {
        time_s: trace.time_s.clone(),
        q_rad: moving.q_rad.clone(),
        command_v: moving.command_v.clone(),
        carried_rad,
        signals: by_sample,
        regressors,
    })
}

/// A joint's smoothed acceleration at every sample of a log [rad/s^2].
fn acceleration(trace: &Trace, joint: u8, known: &Known) -> Option<Vec<f64>> {
    const VELOCITY_NOISE_RAD_PER_S: f64 = 1e-4;
    let neighbour = trace.joint(joint)?;
    let how =
        Smoothing::for_encoder(known.encoder_step_rad, trace.period_s, VELOCITY_NOISE_RAD_PER_S);
    let how = Smoothing { step_s: trace.period_s, ..how };
    let motion = smoothed(&trace.time_s, &neighbour.q_rad, &neighbour.command_v, &how);
    let first_s = *motion.time_s.first()?;
    let at = |time_s: &f64| {
        let point = (time_s - first_s) / motion.step_s;
        let point = point.round().max(0.0) as usize;
        motion.qdd_rad_per_s2[point.min(motion.len() - 1)]
    };
    Some(trace.time_s.iter().map(at).collect())
}

/// What is believed of the noises before the innovations tell better.
pub fn expected_noise(known: &Known) -> Noise {
    const COMMAND_V: f64 = 4e-3;
    let step_rad = known.encoder_step_rad;
    Noise { measurement_rad2: step_rad * step_rad / 12.0, command_v2: COMMAND_V * COMMAND_V }
}
