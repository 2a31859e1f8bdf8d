//! What a function of one axis explains.

use crate::result::Axis;

/// What a function of one axis explains on one joint.
#[derive(Clone, Debug)]
pub(super) struct Found {
    /// The axis.
    pub axis: Axis,
    /// What it takes off the sum of squares [V^2].
    pub energy_v2: f64,
    /// The function in words.
    pub detail: String,
    /// The function at every sample [V].
    pub fitted_v: Vec<f64>,
}
