//! How far what a model leaves is above the noise.

use super::linearisation::Linearisation;
use super::unknowns::Unknown;
use crate::criteria::FitCriteria;
use crate::rows::evidence::Evidence;

/// What a model leaves, against the noise.
#[derive(Clone, Debug, PartialEq)]
pub struct ResidualStats {
    /// Rms over what noise, and what is not known of the model, make of it; by joint of the rig
    /// and stretch.
    pub ratios: Vec<Vec<f64>>,
    /// Squares above what the method itself may leave, in units of noise, all rows.
    pub excess: f64,
    /// Squares of all rows, train and held out, in units of noise.
    pub squares: f64,
    /// The same by joint of the rig.
    pub squares_by_joint: Vec<f64>,
    /// Squares of the rows held out.
    pub held_out_squares: f64,
    /// Rms over what the encoder's steps alone must leave, of the joint where it is smallest.
    pub over_encoder_noise: f64,
    /// Sum of the squared deviations of refitted parameters from the model as given, in standard
    /// deviations of the prior.
    pub prior_penalty: f64,
}

impl ResidualStats {
    /// What a fitted model leaves.
    pub fn of(evidence: &Evidence, linear: &Linearisation) -> Self {
        let own_ratio = evidence.criteria.fit.own_ratio;
        let (mut ratios, mut excess, mut held_out_squares) = (Vec::new(), 0.0, 0.0);
        let (mut squares_by_joint, mut over_encoder_noise) = (Vec::new(), f64::INFINITY);
        for &joint in &evidence.joints {
            let (mut own, mut least, mut all) = (0.0, 0.0, 0.0);
            let mut of_joint = Vec::new();
            for (s, range) in evidence.ranges(joint).into_iter().enumerate() {
                let rows = &linear.residual[joint][range.clone()];
                // A joint at rest that nothing drives leaves exact zeros, and no noise either.
                let settled = rows[evidence.first_settled_row(joint, s)..].iter();
                let used = settled.filter(|row| **row != 0.0).count().max(1) as f64;
                let squares: f64 = rows.iter().map(|row| row * row).sum();
                // Motions that the train logs do not hold show what is not known of the model.
                let expected = match s < evidence.train_stretches() {
                    true => used,
                    false => used + linear.spread(joint, range),
                };
                of_joint.push((squares / expected).sqrt());
                excess += (squares - own_ratio * own_ratio * expected).max(0.0);
                all += squares;
                own += squares * evidence.floor_v(joint, s).powi(2);
                least += used * evidence.steps_v(joint, s).powi(2);
                held_out_squares += if s < evidence.train_stretches() { 0.0 } else { squares };
            }
            ratios.push(of_joint);
            squares_by_joint.push(all);
            over_encoder_noise = f64::min(over_encoder_noise, (own / least.max(1e-300)).sqrt());
        }
        Self {
            ratios,
            excess,
            squares: squares_by_joint.iter().sum(),
            squares_by_joint,
            held_out_squares,
            over_encoder_noise,
            prior_penalty: prior_penalty(linear),
        }
    }

    /// Whether nothing is left that asks for a cause.
    pub fn is_clean(&self, criteria: &FitCriteria) -> bool {
        self.excess == 0.0 && self.prior_penalty < criteria.unexplained_prior_penalty
    }

    /// Whether the parameters are too far from what is known of them to be those of the robot.
    pub fn is_implausible(&self, criteria: &FitCriteria) -> bool {
        self.prior_penalty > criteria.implausible_prior_penalty
    }

    /// The largest ratio to the noise.
    pub fn worst(&self) -> f64 {
        self.ratios.iter().flatten().copied().fold(0.0, f64::max)
    }
}

/// Squared deviations of those parameters that logs like these determine.
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
