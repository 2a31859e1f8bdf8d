//! A rig of one joint, eq. (11).

use serde::{Deserialize, Serialize};

use crate::Real;
use crate::parameter::{ParameterError, named};

/// The one-joint rigid body of eq. (11): k_t u = J qdd + l sin q, q measured from hanging down.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pendulum<T> {
    /// Which joint of the robot this is, 1 to 3.
    pub joint: u8,
    /// Inertia J about the joint [kg m^2].
    pub inertia_kg_m2: T,
    /// Gravity torque l at the level position [Nm]; 0 for a joint without gravity.
    #[serde(rename = "gravity_torque_Nm")]
    pub gravity_torque_nm: T,
}

impl<T: Real> Pendulum<T> {
    /// The torque [Nm] that gives an acceleration.
    pub fn inverse_dynamics(&self, q_rad: T, qdd_rad_per_s2: T) -> T {
        self.inertia_kg_m2 * qdd_rad_per_s2 + self.gravity_torque_nm * q_rad.sin_cos().0
    }

    /// The acceleration [rad/s^2] that a torque gives.
    pub fn forward_dynamics(&self, q_rad: T, torque_nm: T) -> T {
        (torque_nm - self.gravity_torque_nm * q_rad.sin_cos().0) / self.inertia_kg_m2
    }

    /// Checks that the inertia is positive and gravity finite.
    pub fn check(&self) -> Result<(), ParameterError> {
        let joint = self.joint;
        named("joint", T::constant(f64::from(joint)))
            .require((1..=3).contains(&joint), "be 1, 2 or 3")?;
        named("inertia_kg_m2", self.inertia_kg_m2).of_joint(joint).positive()?;
        named("gravity_torque_Nm", self.gravity_torque_nm).of_joint(joint).finite()?;
        Ok(())
    }
}
