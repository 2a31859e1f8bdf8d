//! Estimates of a joint's friction.

use model::Friction;
use nalgebra::DMatrix;
use serde::Serialize;

use crate::base_parameters::FrictionEstimate;
use crate::estimate::Estimate;

/// The parameters of a joint's friction, eq. (9)-(10), LuGre and Stribeck.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FrictionEstimates {
    /// Coulomb level alpha_0 [V].
    #[serde(rename = "alpha0_V")]
    pub alpha0_v: Estimate,
    /// Static level above it alpha_1 [V].
    #[serde(rename = "alpha1_V")]
    pub alpha1_v: Estimate,
    /// Breakaway level alpha_0 + alpha_1 [V].
    #[serde(rename = "breakaway_V")]
    pub breakaway_v: Estimate,
    /// Stribeck velocity v_s [rad/s].
    pub stribeck_velocity_rad_per_s: Estimate,
    /// Viscous coefficient alpha_2 [V s/rad].
    #[serde(rename = "alpha2_V_s_per_rad")]
    pub alpha2_v_s_per_rad: Estimate,
    /// Stiffness sigma_0 [V/rad].
    #[serde(rename = "sigma0_V_per_rad")]
    pub sigma0_v_per_rad: Estimate,
    /// Damping sigma_1 [V s/rad].
    #[serde(rename = "sigma1_V_s_per_rad")]
    pub sigma1_v_s_per_rad: Estimate,
}

impl FrictionEstimates {
    /// From the logarithms of [`crate::one_joint::parameters`] and their covariance, both
    /// perhaps with further parameters behind.
    pub fn from_logarithms(logarithms: &[f64], covariance: &DMatrix<f64>) -> Self {
        let estimate = |k: usize| log_normal(logarithms[k], covariance[(k, k)].max(0.0).sqrt());
        Self {
            alpha0_v: estimate(0),
            alpha1_v: alpha1(logarithms, covariance),
            breakaway_v: estimate(1),
            stribeck_velocity_rad_per_s: estimate(2),
            alpha2_v_s_per_rad: estimate(3),
            sigma0_v_per_rad: estimate(4),
            sigma1_v_s_per_rad: estimate(5),
        }
    }

    /// The parameters of [`model::friction_parameters::NAMES`].
    fn parameters(&self) -> [&Estimate; model::friction_parameters::COUNT] {
        [
            &self.alpha0_v,
            &self.alpha1_v,
            &self.stribeck_velocity_rad_per_s,
            &self.alpha2_v_s_per_rad,
            &self.sigma0_v_per_rad,
            &self.sigma1_v_s_per_rad,
        ]
    }

    /// The estimated values.
    pub fn values(&self) -> Friction<f64> {
        Friction::from_array(self.parameters().map(|estimate| estimate.value))
    }

    /// With every estimate replaced.
    pub fn map(self, replace: impl Fn(Estimate) -> Estimate) -> Self {
        Self {
            alpha0_v: replace(self.alpha0_v),
            alpha1_v: replace(self.alpha1_v),
            breakaway_v: replace(self.breakaway_v),
            stribeck_velocity_rad_per_s: replace(self.stribeck_velocity_rad_per_s),
            alpha2_v_s_per_rad: replace(self.alpha2_v_s_per_rad),
            sigma0_v_per_rad: replace(self.sigma0_v_per_rad),
            sigma1_v_s_per_rad: replace(self.sigma1_v_s_per_rad),
        }
    }

    /// Values and standard errors.
    pub fn with_standard_errors(&self) -> FrictionEstimate {
        let errors = self.parameters().map(|estimate| estimate.standard_error);
        FrictionEstimate { value: self.values(), standard_error: Friction::from_array(errors) }
    }
}

/// The value behind a logarithm, with an interval that stays positive.
fn log_normal(logarithm: f64, error: f64) -> Estimate {
    let value = logarithm.exp();
    let at = |deviations: f64| (logarithm + deviations * error).exp();
    let normal = Estimate::new(value, value * error);
    Estimate { interval: [at(-1.96), at(1.96)], ..normal }
}

/// alpha_1 = breakaway level - Coulomb level.
fn alpha1(logarithms: &[f64], covariance: &DMatrix<f64>) -> Estimate {
    let (coulomb, breakaway) = (logarithms[0].exp(), logarithms[1].exp());
    let variance = coulomb * coulomb * covariance[(0, 0)]
        + breakaway * breakaway * covariance[(1, 1)]
        - 2.0 * coulomb * breakaway * covariance[(0, 1)];
    Estimate::new(breakaway - coulomb, variance.max(0.0).sqrt())
}
