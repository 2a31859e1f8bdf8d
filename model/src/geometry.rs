//! The robot's lengths, from its data sheet.

use serde::{Deserialize, Serialize};

use crate::Real;
use crate::parameter::{ParameterError, named};

/// The posture in which the arm hangs down and gravity asks for nothing [rad].
pub const HANGING_RAD: [f64; 3] = [0.0, -core::f64::consts::FRAC_PI_2, 0.0];

/// Denavit-Hartenberg lengths of Table 1, and gravity.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Geometry<T> {
    /// Gravity, along -z0 [m/s^2].
    pub gravity_m_s2: T,
    /// Height of joint 2 above the base [m].
    pub d1_m: T,
    /// Offset of link 2 along its joint axis [m].
    pub d2_m: T,
    /// Length of link 2 [m].
    pub a2_m: T,
    /// Offset of link 3 along its joint axis [m].
    pub d3_m: T,
    /// Length of link 3 [m].
    pub a3_m: T,
}

impl<T: Real> Geometry<T> {
    /// The same lengths in another number type.
    pub fn cast<U: Real>(&self) -> Geometry<U> {
        let cast = |x: T| U::constant(x.as_f64());
        Geometry {
            gravity_m_s2: cast(self.gravity_m_s2),
            d1_m: cast(self.d1_m),
            d2_m: cast(self.d2_m),
            a2_m: cast(self.a2_m),
            d3_m: cast(self.d3_m),
            a3_m: cast(self.a3_m),
        }
    }

    /// Checks that every length is finite, and gravity and link lengths not negative.
    pub fn check(&self) -> Result<(), ParameterError> {
        named("gravity_m_s2", self.gravity_m_s2).not_negative()?;
        named("d1_m", self.d1_m).finite()?;
        named("d2_m", self.d2_m).finite()?;
        named("a2_m", self.a2_m).not_negative()?;
        named("d3_m", self.d3_m).finite()?;
        named("a3_m", self.a3_m).not_negative()?;
        Ok(())
    }
}
