//! Numbers that the fit and its limits share.

/// Tolerance of the searches once rows are weighted.
pub(super) const FINELY: f64 = 1e-6;
/// Standard error of ln v_s from which on the log does not tell the Stribeck curve.
pub(super) const BARELY_KNOWN: f64 = 0.5;
