//! The results of one step as the prior of the next.

use model::Friction;

use crate::base_parameters::BaseResult;
use crate::base_parameters::FrictionEstimate;
use crate::ekf::EkfResult;
use crate::friction_law::{CERTAIN, as_static, stiffness_in_errors};
use crate::presliding::{Presliding, Prior, Sliding};
use crate::static_friction::StaticFriction;

/// Where the search begins for a joint of which nothing is known, as the paper's joints are.
const TYPICAL: Friction<f64> = Friction {
    alpha0_v: 0.3,
    alpha1_v: 0.0,
    stribeck_velocity_rad_per_s: 0.003,
    alpha2_v_s_per_rad: 0.1,
    sigma0_v_per_rad: 400.0,
    sigma1_v_s_per_rad: 3.0,
};

/// Friction of a joint from the steps on it alone: the run at constant velocities, else
/// the augmented filter, else nothing.
///
/// Motion of all joints does not determine the Stribeck curve, so without those steps it
/// stays at what is typical; the rest comes from that motion, bristles from its reversals.
pub fn of_joint(found: Option<&StaticFriction>, filtered: Option<&EkfResult>) -> FrictionEstimate {
    if let Some(found) = found {
        return found.friction.with_standard_errors();
    }
    if let Some(found) = filtered {
        return found.friction.with_standard_errors();
    }
    let open = f64::INFINITY;
    let unknown = Friction {
        alpha0_v: open,
        alpha2_v_s_per_rad: open,
        sigma0_v_per_rad: open,
        sigma1_v_s_per_rad: open,
        ..Friction::from_array([0.0; 6])
    };
    FrictionEstimate { value: TYPICAL, standard_error: unknown }
}

/// The same by static friction alone.
pub fn without_bristles(
    found: Option<&StaticFriction>,
    filtered: Option<&EkfResult>,
) -> FrictionEstimate {
    let own = found.map(|found| found.without_bristles.with_standard_errors());
    as_static(&own.unwrap_or_else(|| of_joint(found, filtered)))
}

/// The prior of the FRF: the mass matrix and sliding friction.
pub fn of_presliding(base: &BaseResult, statics: &[Option<StaticFriction>; 3]) -> Prior {
    /// Least squares on an excitation gives the mass matrix that well.
    const MASS_MATRIX_ERROR: f64 = 0.01;
    let prior = Prior::with_base(base.base, MASS_MATRIX_ERROR);
    statics.iter().flatten().fold(prior, |prior, found| {
        let friction = &found.friction;
        let sliding = Sliding {
            alpha0_v: friction.alpha0_v.clone(),
            alpha1_v: friction.alpha1_v.clone(),
            stribeck_velocity_rad_per_s: friction.stribeck_velocity_rad_per_s.clone(),
            alpha2_v_s_per_rad: friction.alpha2_v_s_per_rad.clone(),
        };
        prior.with_sliding(found.joint, sliding)
    })
}

/// Takes the FRF's bristles in place of those before, where it shows any.
pub fn take_bristles(estimate: &mut FrictionEstimate, found: &Presliding) {
    if stiffness_in_errors(found) < CERTAIN {
        return;
    }
    estimate.value.sigma0_v_per_rad = found.sigma0_v_per_rad.value;
    estimate.value.sigma1_v_s_per_rad = found.sigma1_v_s_per_rad.value;
    estimate.standard_error.sigma0_v_per_rad = found.sigma0_v_per_rad.standard_error;
    estimate.standard_error.sigma1_v_s_per_rad = found.sigma1_v_s_per_rad.standard_error;
}
