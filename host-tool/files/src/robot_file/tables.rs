//! The tables of a robot or model file, key by key.

use model::{Friction, Geometry, Robot};
use serde::{Deserialize, Serialize, Serializer};

/// `[robot]`: the manufacturer's data.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RobotTable {
    /// Gravity [m/s^2].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub gravity_m_s2: Option<f64>,
    /// Height of joint 2 [m]; like all lengths absent for a rig of one joint.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub d1_m: Option<f64>,
    /// Offset of link 2 [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub d2_m: Option<f64>,
    /// Length of link 2 [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub a2_m: Option<f64>,
    /// Offset of link 3 [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub d3_m: Option<f64>,
    /// Length of link 3 [m].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub a3_m: Option<f64>,
    /// Torque constants [Nm/V], one per joint, or one alone for a rig of one joint.
    #[serde(rename = "torque_constant_Nm_per_V")]
    pub torque_constant_nm_per_v: Vec<f64>,
    /// Encoder counts per turn.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "whole_if_possible")]
    pub encoder_counts_per_rev: Option<f64>,
    /// Sample period [s].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sample_period_s: Option<f64>,
    /// Largest command, either way [V].
    #[serde(rename = "command_limit_V", skip_serializing_if = "Option::is_none")]
    pub command_limit_v: Option<f64>,
    /// Resolution of the converter that puts the command out [bit].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub command_bits: Option<u32>,
    /// Lower and upper end of each joint's range [rad], one pair per joint, or one alone for a rig
    /// of one joint; absent where joints may turn without end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limits_rad: Option<Vec<[f64; 2]>>,
    /// Command whose current each motor bears for ever [V], one a joint, or one alone; absent where
    /// nobody has told.
    #[serde(rename = "motor_continuous_V", skip_serializing_if = "Option::is_none")]
    pub motor_continuous_v: Option<Vec<f64>>,
    /// Time constant with which each motor's winding warms [s].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motor_time_constant_s: Option<Vec<f64>>,
    /// Other keys.
    #[serde(skip)]
    pub extra: toml::Table,
}

/// `[pendulum]`: the rigid body of a rig of one joint, eq. (11).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PendulumTable {
    /// Which joint, 1 to 3.
    pub joint: u8,
    /// Inertia [kg m^2]; absent until it is identified.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<f64>,
    /// Gravity torque at the level position [Nm]; absent until it is identified.
    #[serde(rename = "gravity_torque_Nm", skip_serializing_if = "Option::is_none")]
    pub gravity_torque_nm: Option<f64>,
    /// Other keys.
    #[serde(skip)]
    pub extra: toml::Table,
}

/// `[[friction]]`: a joint's friction, eq. (9)-(10).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FrictionTable {
    /// Which joint, 1 to 3.
    pub joint: u8,
    /// Coulomb level [V].
    #[serde(rename = "alpha0_V")]
    pub alpha0_v: f64,
    /// Static level above the Coulomb level [V].
    #[serde(rename = "alpha1_V")]
    pub alpha1_v: f64,
    /// Stribeck velocity [rad/s].
    pub stribeck_velocity_rad_per_s: f64,
    /// Viscous coefficient [V s/rad].
    #[serde(rename = "alpha2_V_s_per_rad")]
    pub alpha2_v_s_per_rad: f64,
    /// Pre-sliding stiffness [V/rad]; absent where only static friction is known.
    #[serde(rename = "sigma0_V_per_rad", skip_serializing_if = "Option::is_none")]
    pub sigma0_v_per_rad: Option<f64>,
    /// Pre-sliding damping [V s/rad]; absent where only static friction is known.
    #[serde(rename = "sigma1_V_s_per_rad", skip_serializing_if = "Option::is_none")]
    pub sigma1_v_s_per_rad: Option<f64>,
    /// Other keys.
    #[serde(skip)]
    pub extra: toml::Table,
}

/// `[[effect]]`: one effect of the catalogue, as data.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EffectTable {
    /// The effect's name in the catalogue.
    pub effect: String,
    /// Which joint, 1 to 3, or 0 for the whole robot.
    pub joint: u8,
    /// Its parameters by name, with units.
    #[serde(default)]
    pub parameters: toml::Table,
    /// Other keys.
    #[serde(skip)]
    pub extra: toml::Table,
}

impl RobotTable {
    /// Lengths, gravity and torque constants of a robot.
    pub fn of_robot(robot: &Robot<f64>) -> Self {
        let Geometry { gravity_m_s2, d1_m, d2_m, a2_m, d3_m, a3_m } = robot.geometry;
        Self {
            gravity_m_s2: Some(gravity_m_s2),
            d1_m: Some(d1_m),
            d2_m: Some(d2_m),
            a2_m: Some(a2_m),
            d3_m: Some(d3_m),
            a3_m: Some(a3_m),
            torque_constant_nm_per_v: robot.torque_constant_nm_per_v.to_vec(),
            ..Self::default()
        }
    }
}

impl FrictionTable {
    /// The friction of a joint, 1 to 3.
    pub fn of(joint: u8, friction: &Friction<f64>) -> Self {
        Self {
            joint,
            alpha0_v: friction.alpha0_v,
            alpha1_v: friction.alpha1_v,
            stribeck_velocity_rad_per_s: friction.stribeck_velocity_rad_per_s,
            alpha2_v_s_per_rad: friction.alpha2_v_s_per_rad,
            sigma0_v_per_rad: Some(friction.sigma0_v_per_rad),
            sigma1_v_s_per_rad: Some(friction.sigma1_v_s_per_rad),
            extra: toml::Table::new(),
        }
    }
}

impl EffectTable {
    /// A parameter that is a number.
    pub fn number(&self, name: &str) -> Option<f64> {
        as_number(self.parameters.get(name)?)
    }

    /// A parameter that is a vector x, y, z.
    pub fn vector(&self, name: &str) -> Option<[f64; 3]> {
        let values = self.parameters.get(name)?.as_array()?;
        let numbers: Option<Vec<f64>> = values.iter().map(as_number).collect();
        numbers?.try_into().ok()
    }
}

/// A TOML number, whole or not.
pub(super) fn as_number(value: &toml::Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

/// Writes counts as people do, without a point.
pub(crate) fn whole_if_possible<S: Serializer>(
    value: &Option<f64>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    const LARGEST_EXACT: f64 = (1_u64 << 53) as f64;
    match value {
        Some(value) if value.fract() == 0.0 && value.abs() <= LARGEST_EXACT => {
            serializer.serialize_i64(*value as i64)
        }
        other => other.serialize(serializer),
    }
}
