//! A log as samples of one joint, with what its neighbours do.

use super::dynamics::{INERTIA, Inputs, Regressor};
use super::rows::Term;
use model::HANGING_RAD;
use recordings::campaign::{JointTrace, Known, Trace};
use recordings::smoothed::{Smoothing, smoothed};

/// A joint's samples and its external inputs.
#[derive(Clone, Debug, Default)]
pub struct Samples {
    /// Times [s].
    pub time_s: Vec<f64>,
    /// Measured angle [rad].
    pub q_rad: Vec<f64>,
    /// Command from each sample on [V].
    pub command_v: Vec<f64>,
    /// Angle of the parent joint [rad]; empty where there is none.
    pub parent_rad: Vec<f64>,
    /// External signals at each sample; empty where there are none.
    pub signals: Vec<Vec<f64>>,
    /// What the linear terms multiply.
    pub regressors: Vec<Regressor>,
}

impl Samples {
    /// How many parameters the joint has.
    pub fn parameters(&self) -> usize {
        INERTIA + 1 + self.regressors.len()
    }

    /// The inputs from sample `k` to the next, for a step of it.
    pub(crate) fn inputs(&self, k: usize, step_s: f64) -> Inputs<'_> {
        Inputs {
            command_v: self.command_v[k],
            step_s,
            parent_rad: self.parent_rad.get(k).copied().unwrap_or(0.0),
            signals: self.signals.get(k).map_or(&[], |s| s.as_slice()),
        }
    }

    /// Number and length [s] of the steps from sample `k` to the next, of a few
    /// milliseconds at most.
    pub(crate) fn steps(&self, k: usize) -> (usize, f64) {
        const LONGEST_S: f64 = 2.5e-3;
        let interval_s = self.time_s[k + 1] - self.time_s[k];
        let count = (interval_s / LONGEST_S).ceil().max(1.0);
        (count as usize, interval_s / count)
    }

    /// The samples from one index to before another.
    pub fn part(&self, from: usize, to: usize) -> Self {
        let to = to.min(self.time_s.len());
        let cut = |values: &[f64]| values.get(from..to).map_or_else(Vec::new, <[f64]>::to_vec);
        Self {
            time_s: cut(&self.time_s),
            q_rad: cut(&self.q_rad),
            command_v: cut(&self.command_v),
            parent_rad: cut(&self.parent_rad),
            signals: self.signals.get(from..to).map_or_else(Vec::new, <[Vec<f64>]>::to_vec),
            regressors: self.regressors.clone(),
        }
    }
}

/// The samples of a log, for linear terms of which the first is inertia; `None` where
/// the joint is not in the log.
pub fn samples(trace: &Trace, joint: u8, terms: &[Term], known: &Known) -> Option<Samples> {
    let moving = trace.joint(joint)?;
    let mut signals: Vec<Vec<f64>> = Vec::new();
    let mut regressors = Vec::new();
    for &term in terms {
        regressors.push(match term {
            Term::Inertia => continue,
            Term::GravityCosine => Regressor::Cosine,
            Term::GravitySine => Regressor::Sine,
            Term::Neighbour(_) | Term::NeighbourCosine(_) | Term::Compliance => {
                signals.push(coupling(trace, moving, term, known)?);
                Regressor::Signal(signals.len() - 1)
            }
        });
    }
    let by_sample = match signals.is_empty() {
        true => Vec::new(),
        false => (0..trace.len()).map(|k| signals.iter().map(|s| s[k]).collect()).collect(),
    };
    let parent_rad = match (joint, trace.joint(2)) {
        (3, Some(second)) => second.q_rad.clone(),
        (3, None) => vec![HANGING_RAD[1]; trace.len()],
        _ => Vec::new(),
    };
    Some(Samples {
        time_s: trace.time_s.clone(),
        q_rad: moving.q_rad.clone(),
        command_v: moving.command_v.clone(),
        parent_rad,
        signals: by_sample,
        regressors,
    })
}

/// The signal that a term of the neighbours' motion multiplies.
fn coupling(trace: &Trace, own: &JointTrace, term: Term, known: &Known) -> Option<Vec<f64>> {
    match term {
        Term::Neighbour(n) => acceleration(trace, n, known),
        Term::NeighbourCosine(n) => {
            let by_cosine = acceleration(trace, n, known)?.into_iter().zip(&own.q_rad);
            Some(by_cosine.map(|(qdd, q)| qdd * q.cos()).collect())
        }
        Term::Compliance => {
            let third = &trace.joint(3)?.q_rad;
            let held_rad = third.iter().sum::<f64>() / third.len().max(1) as f64;
            let by_sine = third.iter().zip(&own.q_rad);
            Some(by_sine.map(|(q3, q2)| (held_rad - q3) * q2.sin()).collect())
        }
        Term::Inertia | Term::GravityCosine | Term::GravitySine => None,
    }
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
