//! How far what a model leaves is above the noise.

use super::linearisation::Linearisation;
use super::unknowns::Unknown;
use crate::rows::evidence::Evidence;

/// What a model leaves, against the noise.
#[derive(Clone, Debug, PartialEq)]
pub struct ResidualStats {
    /// Root mean square over what noise, and what is not known of the model, make of it; by joint of the
    /// rig and stretch.
    pub ratios: Vec<Vec<f64>>,
    /// Squares above what the method itself may leave, in units of noise, all rows.
    pub excess: f64,
    /// Squares of all rows, train and held out, in units of noise.
    pub rows: f64,
    /// The same by joint of the rig.
    pub rows_of: Vec<f64>,
    /// Root mean square over what the encoder's steps must leave, of the joint where it is
    /// smallest.
    pub of_steps: f64,
    /// Those of rows held out alone.
    pub held_out: f64,
    /// Squares by which retuned parameters miss what is known of them, in deviations.
    pub prior_penalty: f64,
}

/// What the method itself leaves of robots without effect: friction around reversals, where
/// velocity is hardest to know, reaches 1.5 times the noise on one joint of one log.
pub const OWN_RATIO: f64 = 1.5;
/// Squared misses of parameters that ask for a cause; some thirty parameters that are known
/// to their deviation make thirty.
pub const PRIOR_PENALTY: f64 = 60.0;
/// Squared misses with which a model is no longer the one that was given: parameters some
/// ten deviations off, a quarter of their values.
pub const BEYOND_BELIEF: f64 = 240.0;

impl ResidualStats {
    /// What a model leaves once retuned.
    pub fn of(evidence: &Evidence, linear: &Linearisation) -> Self {
        let (mut ratios, mut excess, mut held_out) = (Vec::new(), 0.0, 0.0);
        let (mut rows_of, mut of_steps) = (Vec::new(), f64::INFINITY);
        for &joint in &evidence.joints {
            let (mut own, mut least, mut all) = (0.0, 0.0, 0.0);
            let mut of_joint = Vec::new();
            for (s, range) in evidence.ranges(joint).into_iter().enumerate() {
                let rows = &linear.residual[joint][range.clone()];
                let used = rows.iter().filter(|row| **row != 0.0).count().max(1) as f64;
                let squares: f64 = rows.iter().map(|row| row * row).sum();
                // Motions that the train logs do not hold show what is not known of the model.
                let expected = match s < evidence.train_stretches() {
                    true => used,
                    false => used + linear.spread(joint, range),
                };
                of_joint.push((squares / expected).sqrt());
                excess += (squares - OWN_RATIO * OWN_RATIO * expected).max(0.0);
                all += squares;
                own += squares * evidence.floor_v(joint, s).powi(2);
                least += used * evidence.steps_v(joint, s).powi(2);
                held_out += if s < evidence.train_stretches() { 0.0 } else { squares };
            }
            ratios.push(of_joint);
            rows_of.push(all);
            of_steps = f64::min(of_steps, (own / least.max(1e-300)).sqrt());
        }
        let rows = rows_of.iter().sum();
        Self {
            ratios,
            excess,
            rows,
            rows_of,
            of_steps,
            held_out,
            prior_penalty: prior_penalty(linear),
        }
    }

    /// Whether nothing is left that asks for a cause.
    pub fn is_clean(&self) -> bool {
        self.excess == 0.0 && self.prior_penalty < PRIOR_PENALTY
    }

    /// Whether the parameters are where nobody would look for them.
    pub fn is_beyond_belief(&self) -> bool {
        self.prior_penalty > BEYOND_BELIEF
    }

    /// The largest ratio to the noise.
    pub fn worst(&self) -> f64 {
        self.ratios.iter().flatten().copied().fold(0.0, f64::max)
    }
}

/// Squared misses of those parameters that logs like these determine.
fn prior_penalty(linear: &Linearisation) -> f64 {
    const ALPHA0: usize = 0;
    const ALPHA2: usize = 3;
    let counts = |unknown: Unknown| match unknown {
        Unknown::Base(_) | Unknown::Lag(_) => true,
        Unknown::Friction { parameter, .. } => parameter == ALPHA0 || parameter == ALPHA2,
        Unknown::Effect { .. } => false,
    };
    linear
        .expected
        .iter()
        .filter(|e| counts(e.unknown))
        .map(|e| ((e.unknown.get(&linear.hypothesis) - e.mean) / e.deviation).powi(2))
        .sum()
}
