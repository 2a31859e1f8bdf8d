//! Statistical linearisation of LuGre friction under noise.
//!
//! With g(v) = |v| / gamma(v), eq. (9) reads dz/dt = v - sigma0 g(v) z. For a normally
//! distributed velocity v of mean v0 (a drift under load) and small correlation with z,
//! the best linear approximation is dz/dt = (1 - kappa) v - lambda z with
//! lambda = sigma0 E[g] and kappa = sigma0 z0 E[g'], and the mean deflection
//! z0 = v0 / lambda that lets the joint creep at v0. For the paper's joint 1 at 30 mV
//! RMS lambda is about 7 per second: the spring of the FRF, eq. (12), yields below 1 Hz.

/// What noise does to the bristles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Creep {
    /// Creep rate over stiffness, lambda / sigma_0 = E[g] [rad/(V s)].
    pub rate_per_sigma0: f64,
    /// kappa, the share of the motion that the drift under load takes from the bristles.
    pub drift_share: f64,
}

/// Coulomb level, static level above it [V] and Stribeck velocity [rad/s] of eq. (10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StribeckCurve {
    /// alpha_0 [V].
    pub alpha0_v: f64,
    /// alpha_1 [V].
    pub alpha1_v: f64,
    /// v_s [rad/s].
    pub stribeck_velocity_rad_per_s: f64,
}

impl StribeckCurve {
    /// g(v) = |v| / gamma(v) [rad/(V s)].
    fn yielding(&self, velocity: f64) -> f64 {
        let ratio = velocity / self.stribeck_velocity_rad_per_s;
        velocity.abs() / (self.alpha0_v + self.alpha1_v * (-ratio * ratio).exp())
    }
}

/// The creep under a velocity of standard deviation `velocity_rms` about each of the
/// drifts [rad/s], averaged over them.
pub fn creep(curve: &StribeckCurve, velocity_rms: f64, drifts_rad_per_s: &[f64]) -> Creep {
    if drifts_rad_per_s.is_empty() || velocity_rms <= 0.0 {
        return Creep::default();
    }
    let each = drifts_rad_per_s.iter().map(|&drift| at_drift(curve, velocity_rms, drift));
    let sum = each.fold(Creep::default(), |sum, one| Creep {
        rate_per_sigma0: sum.rate_per_sigma0 + one.rate_per_sigma0,
        drift_share: sum.drift_share + one.drift_share,
    });
    let count = drifts_rad_per_s.len() as f64;
    Creep { rate_per_sigma0: sum.rate_per_sigma0 / count, drift_share: sum.drift_share / count }
}

/// E[g'] = E[g x] / velocity_rms for a standard normal x.
fn at_drift(curve: &StribeckCurve, velocity_rms: f64, drift: f64) -> Creep {
    const HALF_POINTS: i32 = 60;
    const REACH: f64 = 5.0;
    let (mut weights, mut mean, mut first_moment) = (0.0, 0.0, 0.0);
    for point in -HALF_POINTS..=HALF_POINTS {
        let x = REACH * f64::from(point) / f64::from(HALF_POINTS);
        let weight = (-0.5 * x * x).exp();
        let value = weight * curve.yielding(drift + velocity_rms * x);
        weights += weight;
        mean += value;
        first_moment += value * x;
    }
    let share = if mean > 0.0 { drift * first_moment / (velocity_rms * mean) } else { 0.0 };
    Creep { rate_per_sigma0: mean / weights, drift_share: share.clamp(0.0, 0.9) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::{Friction, FrictionState};
    use rand_distr::{Distribution, StandardNormal};

    const CURVE: StribeckCurve =
        StribeckCurve { alpha0_v: 0.25, alpha1_v: 0.05, stribeck_velocity_rad_per_s: 0.003 };

    /// Bristles moved by a known noisy velocity: the gain and the rate that a least-
    /// squares fit of dz/dt = a v - lambda z + constant finds.
    fn fitted(velocity_rms: f64, drift: f64) -> (f64, f64) {
        let friction = Friction {
            alpha0_v: CURVE.alpha0_v,
            alpha1_v: CURVE.alpha1_v,
            stribeck_velocity_rad_per_s: CURVE.stribeck_velocity_rad_per_s,
            alpha2_v_s_per_rad: 0.0,
            sigma0_v_per_rad: 1000.0,
            sigma1_v_s_per_rad: 3.0,
        };
        let mut random = rand_pcg::Pcg64Mcg::new(3);
        let (mut state, mut velocity, step_s) = (FrictionState::default(), 0.0, 2.5e-4);
        let mut normal = nalgebra::Matrix3::<f64>::zeros();
        let mut right = nalgebra::Vector3::<f64>::zeros();
        for tick in 0..400_000 {
            let deviate: f64 = StandardNormal.sample(&mut random);
            velocity = 0.95 * velocity + deviate * velocity_rms * (1.0f64 - 0.95 * 0.95).sqrt();
            let before = state.deflection_rad;
            state.step(&friction, velocity + drift, step_s);
            let row = nalgebra::Vector3::new(velocity, before, 1.0);
            if tick > 10_000 {
                normal += row * row.transpose();
                right += row * ((state.deflection_rad - before) / step_s);
            }
        }
        let solution = normal.try_inverse().unwrap() * right;
        (solution[0], -solution[1])
    }

    #[test]
    fn noise_lets_the_models_bristles_creep_as_computed() {
        let (gain, rate) = fitted(1e-3, 0.0);
        let computed = creep(&CURVE, 1e-3, &[0.0]);
        assert!((rate / (1000.0 * computed.rate_per_sigma0) - 1.0).abs() < 0.05, "{rate}");
        assert!((gain - 1.0).abs() < 0.02, "{gain}");
    }

    #[test]
    fn a_drift_under_load_takes_its_share() {
        let (gain, _) = fitted(1e-3, 3e-4);
        let computed = creep(&CURVE, 1e-3, &[3e-4]);
        assert!(computed.drift_share > 0.05);
        assert!((1.0 - gain - computed.drift_share).abs() < 0.02, "{gain} {computed:?}");
    }
}
