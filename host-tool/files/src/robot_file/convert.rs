//! Robot and model files as the model's types.

use model::parameter::named;
use model::{BaseParameters, Friction, Geometry, ParameterError, Pendulum, Robot};

use super::{FrictionTable, RobotFile};
use crate::error::{FileError, Problem};

impl RobotFile {
    /// The rig of three joints, checked.
    ///
    /// # Errors
    /// A parameter that is missing or that no robot can have, with its line.
    pub fn robot(&self) -> Result<Robot<f64>, FileError> {
        let robot = Robot {
            geometry: self.geometry()?,
            base: self.base_parameters()?,
            torque_constant_nm_per_v: self.torque_constants()?,
            friction: [self.friction(1)?, self.friction(2)?, self.friction(3)?],
        };
        robot.checked().map_err(|error| self.parameter(error))
    }

    /// The rigid body of the rig of one joint, checked.
    ///
    /// # Errors
    /// A parameter that is missing or that no pendulum can have, with its line.
    pub fn pendulum(&self) -> Result<Pendulum<f64>, FileError> {
        let table = self.required(self.pendulum.as_ref(), "", "[pendulum]")?;
        let pendulum = Pendulum {
            joint: table.joint,
            inertia_kg_m2: self.required(table.inertia_kg_m2, "pendulum", "inertia_kg_m2")?,
            gravity_torque_nm: self.required(
                table.gravity_torque_nm,
                "pendulum",
                "gravity_torque_Nm",
            )?,
        };
        pendulum.check().map_err(|error| self.parameter(error))?;
        Ok(pendulum)
    }

    /// Lengths and gravity, checked.
    ///
    /// # Errors
    /// A length that is missing or that no robot can have, with its line.
    pub fn geometry(&self) -> Result<Geometry<f64>, FileError> {
        let length = |value, name| self.required(value, "robot", name);
        let geometry = Geometry {
            gravity_m_s2: length(self.robot.gravity_m_s2, "gravity_m_s2")?,
            d1_m: length(self.robot.d1_m, "d1_m")?,
            d2_m: length(self.robot.d2_m, "d2_m")?,
            a2_m: length(self.robot.a2_m, "a2_m")?,
            d3_m: length(self.robot.d3_m, "d3_m")?,
            a3_m: length(self.robot.a3_m, "a3_m")?,
        };
        geometry.check().map_err(|error| self.parameter(error))?;
        Ok(geometry)
    }

    /// The base parameters as they stand in the file, not checked for being physical.
    ///
    /// # Errors
    /// The file has no `[base]`.
    pub fn base_parameters(&self) -> Result<BaseParameters<f64>, FileError> {
        self.required(self.base, "", "[base]")
    }

    /// The torque constants of three joints [Nm/V], checked.
    ///
    /// # Errors
    /// One that is not above 0, or a file of one joint.
    pub fn torque_constants(&self) -> Result<[f64; 3], FileError> {
        Ok([self.torque_constant(1)?, self.torque_constant(2)?, self.torque_constant(3)?])
    }

    /// The torque constant of a joint, 1 to 3 [Nm/V], checked.
    ///
    /// # Errors
    /// It is missing or not above 0.
    pub fn torque_constant(&self, joint: u8) -> Result<f64, FileError> {
        let value = match self.robot.torque_constant_nm_per_v.as_slice() {
            [only] if self.pendulum.as_ref().is_some_and(|p| p.joint == joint) => Some(*only),
            values if values.len() == 3 => values.get(usize::from(joint).wrapping_sub(1)).copied(),
            _ => None,
        };
        let name = "torque_constant_Nm_per_V";
        let value = self.required(value, "robot", &format!("{name} of joint {joint}"))?;
        named(name, value).of_joint(joint).positive().map_err(|error| self.parameter(error))
    }

    /// The whole friction of a joint, 1 to 3, not checked for being physical.
    ///
    /// # Errors
    /// The joint has no `[[friction]]`, or only static friction.
    pub fn friction(&self, joint: u8) -> Result<Friction<f64>, FileError> {
        let table = self.friction_table(joint)?;
        let missing = |name: &str| {
            let what = format!("{name} of joint {joint}");
            self.source.problem_in(Problem::MissingParameter(what), "friction", Some(joint), name)
        };
        Ok(Friction {
            alpha0_v: table.alpha0_v,
            alpha1_v: table.alpha1_v,
            stribeck_velocity_rad_per_s: table.stribeck_velocity_rad_per_s,
            alpha2_v_s_per_rad: table.alpha2_v_s_per_rad,
            sigma0_v_per_rad: table.sigma0_v_per_rad.ok_or_else(|| missing("sigma0_V_per_rad"))?,
            sigma1_v_s_per_rad: table
                .sigma1_v_s_per_rad
                .ok_or_else(|| missing("sigma1_V_s_per_rad"))?,
        })
    }

    /// The `[[friction]]` of a joint, 1 to 3, which may be static friction alone.
    ///
    /// # Errors
    /// The joint has none.
    pub fn friction_table(&self, joint: u8) -> Result<&FrictionTable, FileError> {
        let found = self.friction.iter().find(|friction| friction.joint == joint);
        self.required(found, "", &format!("[[friction]] of joint {joint}"))
    }

    /// A value that a file may lack, where it must be there: `table` and `name` say which.
    ///
    /// # Errors
    /// It is missing.
    pub fn required<T>(&self, value: Option<T>, table: &str, name: &str) -> Result<T, FileError> {
        value.ok_or_else(|| {
            let what = if table.is_empty() { name.into() } else { format!("{name} in [{table}]") };
            self.source.problem_in(Problem::MissingParameter(what), table, None, name)
        })
    }

    /// A parameter's error at its line.
    fn parameter(&self, error: ParameterError) -> FileError {
        // Some names go on after the key: "zz2r (minor of joints 2 and 3)".
        let key = error.name.split(' ').next().unwrap_or_default();
        let (table, joint) = match key {
            _ if model::base::NAMES.contains(&key) => ("base", None),
            "torque_constant_Nm_per_V" => ("robot", None),
            _ if error.joint == 0 => ("robot", None),
            "joint" | "inertia_kg_m2" | "gravity_torque_Nm" => ("pendulum", None),
            _ => ("friction", Some(error.joint)),
        };
        self.source.problem_in(Problem::Parameter(error), table, joint, key)
    }
}
