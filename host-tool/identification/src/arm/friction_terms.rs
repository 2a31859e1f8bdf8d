//! What a joint's command may have beyond Coulomb's level and viscous friction: a peak near rest, growth with the load,
//! as in gears, a square of the velocity, and a constant.
//!
//! The load is that of the links found before, so links and loads are found in turns.

use model::chain::SerialChain;
use model::mechanism::Mechanism;

use super::layout::{FRICTION, TERMS};
use super::motion::Motion;

/// A term of a joint's friction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Term {
    /// The Stribeck peak of eq. (10), exp(-(qd / v_s)^2) sign(qd) [unit of the command].
    Peak,
    /// |c + h| sign(qd), effect `load_friction` [unit of the command by Nm; by N].
    Load,
    /// |qd| qd, effect `quadratic_drag` [unit of the command by rad^2/s^2; by m^2/s^2].
    Square,
    /// A constant beside friction, which the model does not hold [unit of the command].
    Constant,
}

impl Term {
    /// All of them, in the order of a joint's own numbers.
    pub const ALL: [Self; TERMS] = [Self::Peak, Self::Load, Self::Square, Self::Constant];

    /// Where it stands among a joint's own numbers.
    pub fn number(self) -> usize {
        FRICTION + self as usize
    }

    /// Whether it may be negative: a constant, and friction that grows less than with the velocity.
    pub fn may_be_negative(self) -> bool {
        matches!(self, Self::Square | Self::Constant)
    }
}

/// The terms of a joint's friction.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointTerms {
    /// Which it has, in the order of [`Term::ALL`].
    pub open: [bool; TERMS],
    /// Width of the peak v_s [rad/s; m/s].
    pub stribeck_velocity: f64,
}

/// The terms of all joints.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionTerms {
    /// The chain with its links as far as they are known.
    pub chain: SerialChain<f64>,
    /// Base to tip.
    pub joints: Vec<JointTerms>,
}

impl FrictionTerms {
    /// None but Coulomb's level and viscous friction.
    pub fn none(chain: &SerialChain<f64>) -> Self {
        let joints = vec![JointTerms::default(); chain.joints().count()];
        Self { chain: *chain, joints }
    }

    /// With the terms that stayed open.
    pub fn with_open(mut self, open: &[[bool; TERMS]]) -> Self {
        self.joints.iter_mut().zip(open).for_each(|(joint, open)| joint.open = *open);
        self
    }

    /// Whether there are none.
    pub fn is_none(&self) -> bool {
        self.joints.iter().all(|joint| joint.open == [false; TERMS])
    }

    /// The terms along a motion, per joint; zeros for those that it does not have.
    pub fn columns(&self, motion: &Motion) -> Vec<[Vec<f64>; TERMS]> {
        let loads = self.loads(motion);
        let of_joint = |(joint, terms): (usize, &JointTerms)| {
            let velocity = &motion.states[1][joint];
            let sampled = |of: &dyn Fn(usize, f64) -> f64| -> Vec<f64> {
                velocity.iter().enumerate().map(|(sample, v)| of(sample, *v)).collect()
            };
            let width = terms.stribeck_velocity;
            let mut columns = [
                sampled(&|_, v| (-(v / width).powi(2)).exp() * v.signum()),
                sampled(&|sample, v| loads[joint][sample].abs() * v.signum()),
                sampled(&|_, v| v.abs() * v),
                sampled(&|_, _| 1.0),
            ];
            for (column, _) in columns.iter_mut().zip(terms.open).filter(|(_, open)| !open) {
                column.fill(0.0);
            }
            columns
        };
        self.joints.iter().enumerate().map(of_joint).collect()
    }

    /// Coriolis and gravity torques per joint at all samples [Nm; N].
    fn loads(&self, motion: &Motion) -> Vec<Vec<f64>> {
        let joints = self.joints.len();
        if !self.joints.iter().any(|joint| joint.open[Term::Load as usize]) {
            return vec![vec![0.0; motion.len()]; joints];
        }
        let mut all = vec![Vec::with_capacity(motion.len()); joints];
        let (at_rest, mut torque) = (vec![0.0; joints], vec![0.0; joints]);
        for sample in 0..motion.len() {
            let [q, qd, _] = motion.at(sample);
            self.chain.inverse_dynamics(&q, &qd, &at_rest, &mut torque);
            all.iter_mut().zip(&torque).for_each(|(loads, torque)| loads.push(*torque));
        }
        all
    }
}
