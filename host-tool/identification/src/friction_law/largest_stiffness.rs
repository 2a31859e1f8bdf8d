//! The largest stiffness that data can speak for.

use model::Friction;

use super::certainty::{CERTAIN, stiffness_in_errors};
use crate::presliding::Presliding;

/// The largest sigma0 [V/rad] that encoder and pre-sliding data leave open.
///
/// Bristles bend by gamma / sigma0 before they slide. Where that is less than the error of one
/// reading, a step over sqrt(12), no encoder shows it. Where an FRF shows no stiffness, the joint
/// has none above its estimate and [`CERTAIN`] standard errors.
pub(super) fn largest_stiffness(
    friction: &Friction<f64>,
    encoder_step_rad: f64,
    presliding: Option<&Presliding>,
) -> f64 {
    let level_v = friction.alpha0_v.max(friction.alpha0_v + friction.alpha1_v);
    let by_encoder = level_v * 12f64.sqrt() / encoder_step_rad;
    let shows_none = |found: &&Presliding| stiffness_in_errors(found) < CERTAIN;
    let by_frf = presliding.filter(shows_none).map_or(f64::INFINITY, |found| {
        let sigma0 = &found.sigma0_v_per_rad;
        sigma0.value + CERTAIN * sigma0.standard_error
    });
    by_encoder.min(by_frf)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn travel_below_a_readings_error_is_not_seen() {
        let friction = model::reference_robot::reference_robot::<f64>().friction[0];
        let largest = largest_stiffness(&friction, 1e-5, None);
        let level = friction.alpha0_v + friction.alpha1_v;
        assert!((level / largest * 12f64.sqrt() - 1e-5).abs() < 1e-12);
        assert!(largest > friction.sigma0_v_per_rad);
        assert!(largest_stiffness(&friction, 0.0, None).is_infinite());
    }
}
