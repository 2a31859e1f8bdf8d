//! The model of the three-joint robot.

use serde::{Deserialize, Serialize};

use crate::parameter::{ParameterError, named};
use crate::vector::Vector3;
use crate::{BaseParameters, Friction, Geometry, Real};

/// The complete model: geometry (Table 1), base parameters (eq. (19)), torque constants (eq. (18))
/// and friction (Tables 2 and 3).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Robot<T> {
    /// Lengths and gravity.
    pub geometry: Geometry<T>,
    /// Base parameters, the vector p of eq. (4), identified in eq. (19).
    pub base: BaseParameters<T>,
    /// Torque constants k_t [Nm/V], eq. (18).
    pub torque_constant_nm_per_v: Vector3<T>,
    /// LuGre friction of each joint, eq. (9)-(10).
    pub friction: [Friction<T>; 3],
}

impl<T: Real> Robot<T> {
    /// Checks every parameter.
    ///
    /// # Errors
    /// Names the first parameter that is out of its bounds, and the joint.
    pub fn checked(self) -> Result<Self, ParameterError> {
        self.geometry.check()?;
        for (joint, k_t) in (1..).zip(self.torque_constant_nm_per_v) {
            named("torque_constant_Nm_per_V", k_t).of_joint(joint).positive()?;
        }
        for (joint, friction) in (1..).zip(&self.friction) {
            friction.check(joint)?;
        }
        self.base.check(&self.geometry)?;
        Ok(self)
    }

    /// The same robot in another number type.
    pub fn cast<U: Real>(&self) -> Robot<U> {
        Robot {
            geometry: self.geometry.cast(),
            base: self.base.cast(),
            torque_constant_nm_per_v: self
                .torque_constant_nm_per_v
                .map(|k| U::constant(k.as_f64())),
            friction: self.friction.map(|f| f.cast()),
        }
    }

    /// Torques in Nm as motor voltages, u = tau / k_t as in the regression, eq. (5).
    #[inline]
    pub fn torque_to_voltage(&self, torque_nm: &Vector3<T>) -> Vector3<T> {
        [0, 1, 2].map(|i| torque_nm[i] / self.torque_constant_nm_per_v[i])
    }

    /// Motor voltages as torques in Nm, tau = k_t u.
    #[inline]
    pub fn voltage_to_torque(&self, voltage_v: &Vector3<T>) -> Vector3<T> {
        [0, 1, 2].map(|i| voltage_v[i] * self.torque_constant_nm_per_v[i])
    }
}
