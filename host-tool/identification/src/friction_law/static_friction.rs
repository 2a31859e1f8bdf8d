//! Static friction as the limit of stiff bristles.

use model::friction_parameters;

use crate::Estimate;
use crate::base_parameters::FrictionEstimate;
use crate::refinement::Refined;

/// Bristles that bend so far are settled within a sample of 1 ms at 20 mrad/s, the speed from which
/// on the steps on one joint take it as sliding clearly [rad].
const SETTLED_RAD: f64 = 0.02 * 1e-3;

/// Friction with bristles so stiff that it follows the velocity within a sample at 20 mrad/s, and
/// damped in pre-sliding as in sliding. They are exact: nothing refines them.
pub(crate) fn as_static(friction: &FrictionEstimate) -> FrictionEstimate {
    let mut estimate = *friction;
    let value = &mut estimate.value;
    let level_v = value.alpha0_v.max(value.alpha0_v + value.alpha1_v);
    value.sigma0_v_per_rad = level_v / SETTLED_RAD;
    value.sigma1_v_s_per_rad = value.alpha2_v_s_per_rad;
    estimate.standard_error.sigma0_v_per_rad = 0.0;
    estimate.standard_error.sigma1_v_s_per_rad = 0.0;
    estimate
}

/// The same with another stiffness [V/rad].
pub(super) fn with_stiffness(friction: &FrictionEstimate, sigma0: f64) -> FrictionEstimate {
    let mut estimate = *friction;
    estimate.value.sigma0_v_per_rad = sigma0;
    estimate
}

/// What stands beside sigma0 and sigma1 of a joint without bristles.
const NOTES: [(&str, &str); 2] = [
    ("sigma0_V_per_rad", "static friction: the least stiffness that the data bear"),
    ("sigma1_V_s_per_rad", "static friction: damped in pre-sliding as in sliding"),
];

/// Says of a joint (0 to 2) without bristles that its sigma0 and sigma1 were not found but chosen:
/// each is known to within its own size at best.
pub(crate) fn note_chosen_bristles(refined: &mut Refined, joint: usize) {
    for (name, note) in NOTES {
        let place = friction_parameters::NAMES.iter().position(|n| *n == name);
        let Some((_, estimate)) = place.map(|k| &mut refined.friction_estimates[joint][k]) else {
            continue;
        };
        *estimate = Estimate::new(estimate.value, estimate.value).with_note(note);
    }
}
