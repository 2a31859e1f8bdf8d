//! How far what a model leaves of train logs is above the noise.

use super::linearisation::Linearisation;
use super::unknowns::{Expected, Unknown};
use crate::criteria::FitCriteria;
use crate::rows::evidence::{Evidence, Rows};

/// What a model leaves of train logs, against the noise.
#[derive(Clone, Debug, PartialEq)]
pub struct ResidualStats {
    /// Rms over that of noise, by joint of the rig and train stretch.
    pub ratios: Vec<Vec<f64>>,
    /// Squares above what the method itself may leave, in units of noise.
    pub excess: f64,
    /// Rms over what the encoder's steps alone must leave, of the joint where it is smallest.
    pub over_encoder_noise: f64,
    /// Sum of the squared deviations of refitted parameters from the model as given, in standard
    /// deviations of the prior.
    pub prior_penalty: f64,
    /// The same in units of their tolerance, and without lags below zero that are the log's, which kept commands as of
    /// an instant. Large where the parameters are another robot's.
    pub robot_penalty: f64,
    /// What the penalty is expected to be where the model is as far off as it is thought to be: a parameter that the
    /// logs tell counts one, one that they do not tell nothing.
    pub expected_penalty: f64,
}

/// What a model leaves of one joint.
#[derive(Default)]
struct OfJoint {
    ratios: Vec<f64>,
    excess: f64,
    square_v2: f64,
    steps_v2: f64,
}

impl ResidualStats {
    /// What a fitted model leaves, in volts.
    pub fn of(evidence: &Evidence, linear: &Linearisation, residual_v: &Rows) -> Self {
        let joints: Vec<OfJoint> =
            evidence.joints.iter().map(|&joint| of_joint(evidence, joint, residual_v)).collect();
        let over_steps = |joint: &OfJoint| (joint.square_v2 / joint.steps_v2.max(1e-300)).sqrt();
        Self {
            excess: joints.iter().map(|joint| joint.excess).sum(),
            over_encoder_noise: joints.iter().map(over_steps).fold(f64::INFINITY, f64::min),
            ratios: joints.into_iter().map(|joint| joint.ratios).collect(),
            prior_penalty: penalty(linear, &evidence.criteria.fit, |e| e.deviation),
            robot_penalty: penalty(linear, &evidence.criteria.fit, |e| {
                tolerance(e, linear, evidence)
            }),
            expected_penalty: expected_penalty(linear),
        }
    }

    /// Whether nothing is left that asks for a cause.
    pub fn is_clean(&self, criteria: &FitCriteria) -> bool {
        self.excess == 0.0 && !self.asks_for_cause(criteria)
    }

    /// Whether parameters are further off than what is known of them lets expect: a sum of n squared normal
    /// deviations has the mean n and the variance 2 n.
    pub fn asks_for_cause(&self, criteria: &FitCriteria) -> bool {
        let mean = self.expected_penalty.max(1.0);
        let chance = mean + criteria.unexplained_deviations * (2.0 * mean).sqrt();
        self.prior_penalty > chance
    }

    /// Whether the parameters are too far from what is known of them to be those of the robot.
    pub fn is_implausible(&self, criteria: &FitCriteria) -> bool {
        self.robot_penalty > self.most_robot_penalty(criteria)
    }

    /// The largest [`Self::robot_penalty`] of a plausible model, by how many parameters the logs tell.
    pub fn most_robot_penalty(&self, criteria: &FitCriteria) -> f64 {
        let times_told = (self.expected_penalty / criteria.told_parameters).max(1.0);
        criteria.implausible_prior_penalty * times_told
    }

    /// The largest ratio to the noise.
    pub fn worst(&self) -> f64 {
        self.ratios.iter().flatten().copied().fold(0.0, f64::max)
    }
}

fn of_joint(evidence: &Evidence, joint: usize, residual_v: &Rows) -> OfJoint {
    let own_square = evidence.criteria.fit.own_ratio.powi(2);
    let mut sums = OfJoint::default();
    let ranges = evidence.ranges(joint).into_iter().take(evidence.train_stretches());
    for (s, range) in ranges.enumerate() {
        let rows = &residual_v[joint][range];
        // A joint at rest that nothing drives leaves exact zeros, and no noise either.
        let used = rows.iter().filter(|row| **row != 0.0).count().max(1) as f64;
        let square_v2: f64 = rows.iter().map(|row| row * row).sum();
        let noise_v2 = used * evidence.floor_v(joint, s).powi(2);
        sums.ratios.push((square_v2 / noise_v2).sqrt());
        sums.excess += (square_v2 / noise_v2 - own_square).max(0.0) * used;
        sums.square_v2 += square_v2;
        sums.steps_v2 += used * evidence.steps_v(joint, s).powi(2);
    }
    sums
}

/// Squared deviations, in units of a `deviation`, of those parameters that logs like these determine. One alone, a
/// rotor's inertia say that makes up for friction of another law, does not make another robot.
fn penalty(
    linear: &Linearisation,
    criteria: &FitCriteria,
    deviation: impl Fn(&Expected) -> f64,
) -> f64 {
    let of_arm = linear.expected.iter().filter(|e| is_of_arm(e.unknown));
    of_arm
        .map(|e| ((e.unknown.get(&linear.hypothesis) - e.mean) / deviation(e)).powi(2))
        .map(|square| square.min(criteria.most_penalty_of_one))
        .sum()
}

/// By how much a parameter may be off and be this robot's: by anything where it is a lag below zero of a chain that
/// logging of instants explains.
fn tolerance(expected: &Expected, linear: &Linearisation, evidence: &Evidence) -> f64 {
    let most_s = evidence.criteria.logs.most_early_part * evidence.stretches[0].sampled_s;
    let is_chain = linear.hypothesis.plant.as_chain().is_some();
    let early_s = || -expected.unknown.get(&linear.hypothesis);
    match expected.unknown {
        Unknown::Lag(_) if is_chain && (0.0..most_s).contains(&early_s()) => f64::INFINITY,
        _ => expected.tolerance,
    }
}

/// Its mean over models that are off as their prior says: the fit moves a parameter by the part of its prior
/// variance that the logs take away, 1 - (deviation after / deviation before)^2.
fn expected_penalty(linear: &Linearisation) -> f64 {
    let of_arm = linear.expected.iter().enumerate().filter(|(_, e)| is_of_arm(e.unknown));
    of_arm.map(|(place, e)| 1.0 - (linear.deviation(place) / e.deviation).powi(2).min(1.0)).sum()
}

/// Whether a parameter is the arm's own, and known of it beforehand.
fn is_of_arm(unknown: Unknown) -> bool {
    !unknown.shapes_friction() && !matches!(unknown, Unknown::Effect { .. } | Unknown::Table { .. })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stats(robot_penalty: f64, told: f64) -> ResidualStats {
        ResidualStats {
            ratios: Vec::new(),
            excess: 0.0,
            over_encoder_noise: 1.0,
            prior_penalty: 3.0 * robot_penalty,
            robot_penalty,
            expected_penalty: told,
        }
    }

    #[test]
    fn parameters_are_another_robots_by_how_many_the_logs_tell_and_by_their_tolerance() {
        let criteria = crate::Criteria::default().fit;
        assert!(stats(300.0, 20.0).is_implausible(&criteria));
        assert!(!stats(300.0, 60.0).is_implausible(&criteria));
        assert!(stats(500.0, 60.0).is_implausible(&criteria));
        assert!(!stats(200.0, 5.0).is_implausible(&criteria));
        assert!(stats(200.0, 5.0).asks_for_cause(&criteria));
    }
}
