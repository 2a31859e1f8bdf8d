//! Friction with its standard errors, and what its parameters do to the equations.

use model::Friction;
use model::friction_parameters::COUNT;

use super::rows::Rows;

/// Place of alpha_1 among them, which may be negative.
pub(in super::super) const ALPHA1: usize = 1;
/// Place of alpha_2, which may be zero, and in which friction is linear.
pub(in super::super) const ALPHA2: usize = 3;

/// An estimate of a joint's friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionEstimate {
    /// The values.
    pub value: Friction<f64>,
    /// Their standard errors, entry by entry: zero for a value that is exact, infinity
    /// for one that is only a starting value.
    pub standard_error: Friction<f64>,
}

impl FrictionEstimate {
    /// A friction that is exactly known.
    pub fn exact(value: Friction<f64>) -> Self {
        Self { value, standard_error: Friction::from_array([0.0; COUNT]) }
    }
}

/// What a parameter's changes are measured by: for alpha_1 the level at rest.
pub(in super::super) fn magnitude(values: &[f64; COUNT], parameter: usize) -> f64 {
    match parameter {
        ALPHA1 => values[0] + values[ALPHA1],
        _ => values[parameter],
    }
}

/// Derivative of a joint's friction voltage by one of its parameters, in the equations;
/// `friction_v` is that voltage on the log's clock.
pub(in super::super) fn sensitivity(
    rows: &Rows,
    joint: usize,
    friction: &Friction<f64>,
    parameter: usize,
    friction_v: &[f64],
) -> Vec<f64> {
    if parameter == ALPHA2 {
        return rows.sampler.take(&rows.motion.qd_rad_per_s[joint]);
    }
    let mut values = friction.to_array();
    let step = 1e-4 * magnitude(&values, parameter);
    values[parameter] += step;
    let moved_v = rows.friction_raw_v(joint, &Friction::from_array(values));
    let slope: Vec<f64> = moved_v.iter().zip(friction_v).map(|(a, b)| (a - b) / step).collect();
    rows.sampler.take(&slope)
}
