//! Which column of the linearised equations is which parameter.

use model::base::COUNT;
use model::friction_parameters;

use super::super::base_parameters::FrictionEstimate;

/// Nuisance parameters of timing: the command's lag of each joint, the friction's, and
/// that of the velocities which drive Coriolis and centrifugal torques.
pub(super) const TIMING_COUNT: usize = 7;
/// Place of the last one.
pub(super) const CORIOLIS_LAG: usize = 6;

/// Places of alpha_1 and the Stribeck velocity: a motion that reverses at rad/s^2 crosses
/// 0.003 rad/s within a millisecond and does not determine them. They stay as the earlier
/// steps found them, and their standard errors are carried along.
pub(super) const UNDETERMINED: [usize; 2] = [1, 2];

/// Which friction parameters are refined, and where their columns stand.
pub(super) struct Layout {
    /// Joint and parameter of each column behind base parameters and timing.
    pub free: Vec<(usize, usize)>,
}

impl Layout {
    pub fn of(friction: &[FrictionEstimate; 3]) -> Self {
        let mut free = Vec::new();
        for (joint, estimate) in friction.iter().enumerate() {
            let errors = estimate.standard_error.to_array();
            // What the motion does not determine needs a standard error from elsewhere.
            let refined = |k: &usize| {
                errors[*k] > 0.0 && (errors[*k].is_finite() || !UNDETERMINED.contains(k))
            };
            free.extend((0..friction_parameters::COUNT).filter(refined).map(|k| (joint, k)));
        }
        Self { free }
    }

    /// Parameters behind the base parameters.
    pub fn extra_count(&self) -> usize {
        TIMING_COUNT + self.free.len()
    }

    pub fn column(&self, index: usize) -> usize {
        COUNT + TIMING_COUNT + index
    }
}
