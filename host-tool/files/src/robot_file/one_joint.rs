//! A rig of one joint as the third joint of an arm: eq. (5) of an arm whose other joints stand
//! still, hanging down, is eq. (11).

use model::{BaseParameters, Friction, Geometry, Robot};

use super::RobotFile;
use crate::FileError;

impl RobotFile {
    /// The rig as joint 3 of an arm whose other joints have so much inertia [kg m^2].
    ///
    /// # Errors
    /// A parameter that is missing or that no pendulum can have, with its line.
    pub fn as_third_joint(&self, others_kg_m2: f64) -> Result<Robot<f64>, FileError> {
        let pendulum = self.pendulum()?;
        let gravity_m_s2 = self.robot.gravity_m_s2.unwrap_or(9.81);
        let base = BaseParameters {
            zz1r: others_kg_m2,
            zz2r: others_kg_m2,
            zz3r: pendulum.inertia_kg_m2,
            mx3r: pendulum.gravity_torque_nm / gravity_m_s2,
            ..BaseParameters::from_array([0.0; model::base::COUNT])
        };
        // Without a length, the mass is thought where a point mass would swing alike.
        let pendulum_length_m = match base.mx3r {
            moment if moment > 0.0 => pendulum.inertia_kg_m2 / moment,
            _ => 0.5,
        };
        let geometry = Geometry {
            gravity_m_s2,
            d1_m: 0.0,
            d2_m: 0.0,
            a2_m: 0.0,
            d3_m: 0.0,
            a3_m: self.robot.a3_m.unwrap_or(pendulum_length_m),
        };
        let k_t = self.torque_constant(pendulum.joint)?;
        let friction = self.friction_with_bristles(pendulum.joint)?;
        Ok(Robot { geometry, base, torque_constant_nm_per_v: [k_t; 3], friction: [friction; 3] })
    }

    /// The joint's friction; bristles that bend by a milliradian where none are given.
    fn friction_with_bristles(&self, joint: u8) -> Result<Friction<f64>, FileError> {
        const BENT_RAD: f64 = 1e-3;
        let table = self.friction_table(joint)?;
        let level_v = table.alpha0_v.max(table.alpha0_v + table.alpha1_v).max(1e-6);
        Ok(Friction {
            alpha0_v: table.alpha0_v.max(1e-6),
            alpha1_v: table.alpha1_v,
            stribeck_velocity_rad_per_s: table.stribeck_velocity_rad_per_s,
            alpha2_v_s_per_rad: table.alpha2_v_s_per_rad,
            sigma0_v_per_rad: table.sigma0_v_per_rad.unwrap_or(level_v / BENT_RAD),
            sigma1_v_s_per_rad: table.sigma1_v_s_per_rad.unwrap_or(0.0),
        })
    }
}
