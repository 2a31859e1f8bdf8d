//! The keys of a robot or model file of format 1.

use model::base;
use model::friction_parameters::NAMES;

use crate::known_keys::TableKeys;

const ROBOT: &[&str] = &[
    "name",
    "gravity_m_s2",
    "d1_m",
    "d2_m",
    "a2_m",
    "d3_m",
    "a3_m",
    "torque_constant_Nm_per_V",
    "encoder_counts_per_rev",
    "sample_period_s",
    "command_limit_V",
    "command_bits",
    "limits_rad",
    "motor_continuous_V",
    "motor_time_constant_s",
];

const FRICTION: &[&str] = &["joint", NAMES[0], NAMES[1], NAMES[2], NAMES[3], NAMES[4], NAMES[5]];

/// What a table of an effect may have, in files of both formats.
pub(crate) const EFFECT: &[&str] = &["effect", "joint", "parameters", "probability", "confidence"];

/// Every table with its keys.
pub(super) const KEYS: [TableKeys; 6] = [
    ("", &["format", "robot", "base", "pendulum", "friction", "effect"]),
    ("robot", ROBOT),
    ("base", &base::NAMES),
    ("pendulum", &["joint", "inertia_kg_m2", "gravity_torque_Nm"]),
    ("friction", FRICTION),
    ("effect", EFFECT),
];
