//! When a figure is taken for certain.

use crate::presliding::Presliding;

/// How many times the root of its squares a sum must be: exp(-x^2 / 2) = 1 / 1000.
pub const CERTAIN: f64 = 3.717;

/// sigma0 of an FRF in its standard errors.
pub(crate) fn stiffness_in_errors(found: &Presliding) -> f64 {
    found.sigma0_v_per_rad.value / found.sigma0_v_per_rad.standard_error
}
