//! A joint's friction as a list of parameters, in the order of Tables 2 and 3.

use crate::{Friction, Real};

/// How many parameters there are.
pub const COUNT: usize = 6;

/// Their names.
pub const NAMES: [&str; COUNT] = [
    "alpha0_V",
    "alpha1_V",
    "stribeck_velocity_rad_per_s",
    "alpha2_V_s_per_rad",
    "sigma0_V_per_rad",
    "sigma1_V_s_per_rad",
];

impl<T: Real> Friction<T> {
    /// The values in the order of [`NAMES`].
    pub fn to_array(&self) -> [T; COUNT] {
        [
            self.alpha0_v,
            self.alpha1_v,
            self.stribeck_velocity_rad_per_s,
            self.alpha2_v_s_per_rad,
            self.sigma0_v_per_rad,
            self.sigma1_v_s_per_rad,
        ]
    }

    /// A friction of values in the order of [`NAMES`].
    pub fn from_array(values: [T; COUNT]) -> Self {
        let [alpha0_v, alpha1_v, v_s, alpha2, sigma0, sigma1] = values;
        Self {
            alpha0_v,
            alpha1_v,
            stribeck_velocity_rad_per_s: v_s,
            alpha2_v_s_per_rad: alpha2,
            sigma0_v_per_rad: sigma0,
            sigma1_v_s_per_rad: sigma1,
        }
    }
}
