//! Which column of the linearised equations is which parameter.

use model::Friction;
use model::base::COUNT;

use super::super::base_parameters::friction::{
    ALPHA2, FRICTION_COUNT, FrictionKnowledge, from_array, magnitude, to_array,
};
use super::solution::Solution;

/// Nuisance parameters of timing: the command's lag of each joint, the friction's, and
/// that of the velocities which drive Coriolis and centrifugal torques.
pub(super) const TIMING_COUNT: usize = 7;
/// Place of the last one.
pub(super) const CORIOLIS_LAG: usize = 6;

/// Places of alpha_1 and the Stribeck velocity: a motion that reverses at rad/s^2 crosses
/// 0.003 rad/s within a millisecond and tells nothing of them. They stay as the earlier
/// steps found them, and their doubt is carried along.
pub(super) const UNSEEN: [usize; 2] = [1, 2];

/// Which friction parameters are refined, and where their columns stand.
pub(super) struct Layout {
    /// Joint and parameter of each column behind base parameters and timing.
    pub free: Vec<(usize, usize)>,
}

impl Layout {
    pub fn of(friction: &[FrictionKnowledge; 3]) -> Self {
        let mut free = Vec::new();
        for (joint, knowledge) in friction.iter().enumerate() {
            let errors = to_array(&knowledge.standard_error);
            // What the motion does not tell needs a doubt from elsewhere to carry along.
            let refined =
                |k: &usize| errors[*k] > 0.0 && (errors[*k].is_finite() || !UNSEEN.contains(k));
            free.extend((0..FRICTION_COUNT).filter(refined).map(|k| (joint, k)));
        }
        Self { free }
    }

    /// Parameters behind the base parameters.
    pub fn more_count(&self) -> usize {
        TIMING_COUNT + self.free.len()
    }

    pub fn column(&self, index: usize) -> usize {
        COUNT + TIMING_COUNT + index
    }

    /// Friction after a step, and the step's largest part in standard errors.
    ///
    /// A step changes no value by more than a third, so that none leaves its range.
    pub fn moved(
        &self,
        from: &[Friction<f64>; 3],
        solution: &Solution,
    ) -> ([Friction<f64>; 3], f64) {
        let mut values = from.each_ref().map(to_array);
        let mut largest = 0.0f64;
        let moving = self.free.iter().enumerate().filter(|(_, free)| !UNSEEN.contains(&free.1));
        for (index, &(joint, parameter)) in moving {
            let column = self.column(index);
            let wanted = solution.parameters[column];
            let error = solution.covariance[(column, column)].sqrt();
            let scale = magnitude(&values[joint], parameter);
            let allowed = if parameter == ALPHA2 { f64::INFINITY } else { scale.abs() / 3.0 };
            values[joint][parameter] += wanted.clamp(-allowed, allowed);
            largest = largest.max(wanted.abs() / error);
        }
        for joint in &mut values {
            joint[ALPHA2] = joint[ALPHA2].max(0.0);
        }
        (values.map(from_array), largest)
    }
}
