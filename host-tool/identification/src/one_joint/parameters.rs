//! The parameters of a joint as one list: friction, inertia, factors of the linear terms.

use model::Friction;

/// How many parameters are those of friction.
pub const FRICTION: usize = 6;
/// Index of the logarithm of the viscous coefficient alpha_2.
pub const ALPHA2: usize = 3;
/// Indices of the logarithms of the bristles' stiffness sigma_0 and damping sigma_1.
pub const BRISTLES: [usize; 2] = [4, 5];
/// In the grey-box fit: index of the logarithm of the velocity jitter [rad/s].
pub const JITTER: usize = FRICTION;
/// In the grey-box fit: index of the first linear factor.
pub const LINEAR: usize = FRICTION + 1;

/// The friction's parameters as the fits see them: their logarithms, so that none
/// leaves its valid range. In the place of alpha_1, which may be negative, stands the
/// breakaway level alpha_0 + alpha_1, which may not.
pub fn to_logarithms(friction: &Friction<f64>) -> [f64; FRICTION] {
    [
        friction.alpha0_v.ln(),
        (friction.alpha0_v + friction.alpha1_v).ln(),
        friction.stribeck_velocity_rad_per_s.ln(),
        friction.alpha2_v_s_per_rad.max(1e-9).ln(),
        friction.sigma0_v_per_rad.ln(),
        friction.sigma1_v_s_per_rad.max(1e-9).ln(),
    ]
}

/// The friction of [`to_logarithms`].
pub fn from_logarithms(logarithms: &[f64]) -> Friction<f64> {
    let value = |k: usize| logarithms[k].exp();
    Friction {
        alpha0_v: value(0),
        alpha1_v: value(1) - value(0),
        stribeck_velocity_rad_per_s: value(2),
        alpha2_v_s_per_rad: value(3),
        sigma0_v_per_rad: value(4),
        sigma1_v_s_per_rad: value(5),
    }
}
