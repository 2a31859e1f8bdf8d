//! Friction as a list of parameters, with what is known of each.

use model::Friction;

use super::rows::Rows;

/// Parameters of a joint's friction.
pub const FRICTION_COUNT: usize = 6;

/// Their names, in the order of Tables 2 and 3.
pub const FRICTION_NAMES: [&str; FRICTION_COUNT] = [
    "alpha0_V",
    "alpha1_V",
    "stribeck_velocity_rad_per_s",
    "alpha2_V_s_per_rad",
    "sigma0_V_per_rad",
    "sigma1_V_s_per_rad",
];

/// Place of alpha_1 among them, which may be negative.
pub(in super::super) const ALPHA1: usize = 1;
/// Place of alpha_2, which may be zero, and in which friction is linear.
pub(in super::super) const ALPHA2: usize = 3;

/// What is known of a joint's friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionKnowledge {
    /// The values.
    pub value: Friction<f64>,
    /// Their standard errors, entry by entry: zero for a value without doubt, infinity
    /// for one that is only a start.
    pub standard_error: Friction<f64>,
}

impl FrictionKnowledge {
    /// A friction without doubt.
    pub fn certain(value: Friction<f64>) -> Self {
        Self { value, standard_error: from_array([0.0; FRICTION_COUNT]) }
    }
}

/// A friction's values in the order of [`FRICTION_NAMES`].
pub fn to_array(friction: &Friction<f64>) -> [f64; FRICTION_COUNT] {
    [
        friction.alpha0_v,
        friction.alpha1_v,
        friction.stribeck_velocity_rad_per_s,
        friction.alpha2_v_s_per_rad,
        friction.sigma0_v_per_rad,
        friction.sigma1_v_s_per_rad,
    ]
}

/// A friction of values in the order of [`FRICTION_NAMES`].
pub fn from_array(values: [f64; FRICTION_COUNT]) -> Friction<f64> {
    let [alpha0_v, alpha1_v, v_s, alpha2, sigma0, sigma1] = values;
    Friction {
        alpha0_v,
        alpha1_v,
        stribeck_velocity_rad_per_s: v_s,
        alpha2_v_s_per_rad: alpha2,
        sigma0_v_per_rad: sigma0,
        sigma1_v_s_per_rad: sigma1,
    }
}

/// What a parameter's changes are measured by: for alpha_1 the level at rest.
pub(in super::super) fn magnitude(values: &[f64; FRICTION_COUNT], parameter: usize) -> f64 {
    match parameter {
        ALPHA1 => values[0] + values[ALPHA1],
        _ => values[parameter],
    }
}

/// Derivative of a joint's friction voltage by one of its parameters, in the equations;
/// `friction_v` is that voltage on the log's clock.
pub(in super::super) fn sensitivity(
    rows: &Rows,
    joint: usize,
    friction: &Friction<f64>,
    parameter: usize,
    friction_v: &[f64],
) -> Vec<f64> {
    if parameter == ALPHA2 {
        return rows.sampler.take(&rows.motion.qd_rad_per_s[joint]);
    }
    let mut values = to_array(friction);
    let step = 1e-4 * magnitude(&values, parameter);
    values[parameter] += step;
    let moved_v = rows.friction_raw_v(joint, &from_array(values));
    let slope: Vec<f64> = moved_v.iter().zip(friction_v).map(|(a, b)| (a - b) / step).collect();
    rows.sampler.take(&slope)
}
