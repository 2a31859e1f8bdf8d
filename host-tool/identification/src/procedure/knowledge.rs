//! What one step tells the next.

use model::Friction;

use crate::Estimate;
use crate::base_parameters::BaseResult;
use crate::base_parameters::friction::{FrictionKnowledge, from_array};
use crate::ekf::EkfResult;
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

/// What the steps on one joint know of its friction: the run at constant velocities, else
/// the augmented filter, else nothing.
///
/// Motion of all joints tells nothing of the Stribeck curve, so without those steps it
/// stays at what is typical; the rest comes from that motion, bristles from its reversals.
pub fn of_joint(found: Option<&StaticFriction>, filtered: Option<&EkfResult>) -> FrictionKnowledge {
    if let Some(found) = found {
        let errors = [
            &found.alpha0_v,
            &found.alpha1_v,
            &found.stribeck_velocity_rad_per_s,
            &found.alpha2_v_s_per_rad,
            &found.sigma0_v_per_rad,
            &found.sigma1_v_s_per_rad,
        ];
        return with_errors(found.friction(), errors);
    }
    if let Some(found) = filtered {
        let errors = [
            &found.alpha0_v,
            &found.alpha1_v,
            &found.stribeck_velocity_rad_per_s,
            &found.alpha2_v_s_per_rad,
            &found.sigma0_v_per_rad,
            &found.sigma1_v_s_per_rad,
        ];
        return with_errors(found.friction(), errors);
    }
    let open = f64::INFINITY;
    let unknown = Friction {
        alpha0_v: open,
        alpha2_v_s_per_rad: open,
        sigma0_v_per_rad: open,
        sigma1_v_s_per_rad: open,
        ..none()
    };
    FrictionKnowledge { value: TYPICAL, standard_error: unknown }
}

fn with_errors(value: Friction<f64>, estimates: [&Estimate; 6]) -> FrictionKnowledge {
    let standard_error = from_array(estimates.map(|estimate| estimate.standard_error));
    FrictionKnowledge { value, standard_error }
}

fn none() -> Friction<f64> {
    from_array([0.0; 6])
}

/// What the FRF must know before: the mass matrix and sliding friction.
pub fn prior(base: &BaseResult, statics: &[Option<StaticFriction>; 3]) -> Prior {
    /// Least squares on an excitation gives the mass matrix that well.
    const MASS_MATRIX_ERROR: f64 = 0.01;
    let prior = Prior::with_base(base.base, MASS_MATRIX_ERROR);
    statics.iter().flatten().fold(prior, |prior, found| {
        let sliding = Sliding {
            alpha0_v: found.alpha0_v.clone(),
            alpha1_v: found.alpha1_v.clone(),
            stribeck_velocity_rad_per_s: found.stribeck_velocity_rad_per_s.clone(),
            alpha2_v_s_per_rad: found.alpha2_v_s_per_rad.clone(),
        };
        prior.with_sliding(found.joint, sliding)
    })
}

/// Takes the FRF's bristles in place of what was known of them.
pub fn learn(knowledge: &mut FrictionKnowledge, found: &Presliding) {
    knowledge.value.sigma0_v_per_rad = found.sigma0_v_per_rad.value;
    knowledge.value.sigma1_v_s_per_rad = found.sigma1_v_s_per_rad.value;
    knowledge.standard_error.sigma0_v_per_rad = found.sigma0_v_per_rad.standard_error;
    knowledge.standard_error.sigma1_v_s_per_rad = found.sigma1_v_s_per_rad.standard_error;
}
