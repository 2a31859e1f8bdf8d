//! Effects of joints as tables of a model file: names and parameters of the catalogue.

use files::EffectTable;

use crate::error::ServoError;
use crate::fit::Field;
use crate::joint::ServoJoint;

/// A parameter: its name and the field that holds it.
type Named = (&'static str, Field);

/// The effects on a joint with their parameters; the second of two entries of a name is told from
/// the first by parameters that only it has.
const TABLE: [(&str, &[Named]); 19] = [
    ("saturation", &[("limit_V", Field::Limit)]),
    ("load_friction", &[("coefficient_V_per_Nm", Field::JointLoadFriction)]),
    ("motor_load_friction", &[("coefficient_V_per_Nm", Field::MotorLoadFriction)]),
    (
        "stribeck",
        &[("alpha1_V", Field::Stribeck), ("stribeck_velocity_rad_per_s", Field::StribeckVelocity)],
    ),
    ("viscous_asymmetry", &[("relative_asymmetry", Field::ViscousAsymmetry)]),
    ("asymmetric_friction", &[("relative_asymmetry", Field::Asymmetry)]),
    ("quadratic_drag", &[("coefficient_V_s2_per_rad2", Field::Drag)]),
    ("actuator_lag", &[("time_constant_s", Field::Lag)]),
    ("dead_zone", &[("half_width_V", Field::DeadZone)]),
    ("backlash", &[("gap_rad", Field::Gap)]),
    ("dac_offset", &[("offset_V", Field::Offset)]),
    ("friction_drift", &[("relative_change", Field::Drift), ("time_constant_s", Field::DriftTime)]),
    ("encoder_offset", &[("offset_rad", Field::EncoderOffset)]),
    ("cable_spring", &[("stiffness_V_per_rad", Field::Spring), ("rest_rad", Field::SpringRest)]),
    (
        "cogging",
        &[
            ("harmonic", Field::CoggingOrder),
            ("amplitude_V", Field::CoggingAmplitude),
            ("phase_rad", Field::CoggingPhase),
        ],
    ),
    ("delay", &[("delay_s", Field::Delay)]),
    ("goal_clip", &[("lowest_rad", Field::GoalLow), ("highest_rad", Field::GoalHigh)]),
    ("gravity_scale", &[("scale", Field::Gravity)]),
    ("reading", &[("after_goal_s", Field::ReadAfter)]),
];

/// Load friction's parameter that says whether it goes by the motor's torque.
const BY_MOTOR: &str = "by_motor_torque";

/// The parameters of an effect in a joint, by the catalogue's names.
pub fn parameters(effect: &str, servo: &ServoJoint) -> Vec<(&'static str, f64)> {
    let by_motor = effect == "load_friction" && servo.motor_load_friction != 0.0;
    let name = if by_motor { "motor_load_friction" } else { effect };
    let entry = TABLE.iter().find(|entry| entry.0 == name);
    let named = entry.map_or(&[][..], |entry| entry.1).iter();
    let mut found: Vec<_> = named.map(|(name, field)| (*name, field.of(servo))).collect();
    if effect == "load_friction" {
        found.push((BY_MOTOR, if by_motor { 1.0 } else { 0.0 }));
    }
    found
}

/// The parameter's name that a field has in its effect.
pub fn parameter_name(effect: &str, field: Field) -> Option<&'static str> {
    let is_of = |entry: &&(&str, &[Named])| {
        (entry.0 == effect || (effect == "load_friction" && entry.0 == "motor_load_friction"))
            && entry.1.iter().any(|named| named.1 == field)
    };
    let entry = TABLE.iter().find(is_of)?;
    entry.1.iter().find(|named| named.1 == field).map(|named| named.0)
}

/// Whether a joint of servos can have an effect of the catalogue.
pub fn is_known(effect: &str) -> bool {
    TABLE.iter().any(|entry| entry.0 == effect)
}

/// An effect as a table of a model file; `joint` from 1.
pub fn table(effect: &str, joint: usize, servo: &ServoJoint) -> EffectTable {
    let number = |(name, value): (&'static str, f64)| (name.to_owned(), toml::Value::Float(value));
    EffectTable {
        effect: effect.to_owned(),
        joint: joint as u8,
        parameters: parameters(effect, servo).into_iter().map(number).collect(),
        extra: toml::Table::new(),
    }
}

/// Puts the tables of a model file into its joints; those of the whole arm are left to others.
///
/// # Errors
/// An effect, joint or parameter that is not known here.
pub fn apply(tables: &[EffectTable], servos: &mut [ServoJoint]) -> Result<(), ServoError> {
    for table in tables.iter().filter(|table| table.joint != 0) {
        let unknown = || ServoError::Effect(format!("{} of joint {}", table.effect, table.joint));
        let servo = servos.get_mut(usize::from(table.joint) - 1).ok_or_else(unknown)?;
        let number = |name: &str| table.parameters.get(name).and_then(as_number);
        let by_motor = number(BY_MOTOR).is_some_and(|value| value != 0.0);
        let name = if by_motor { "motor_load_friction" } else { &table.effect };
        let entry = TABLE.iter().find(|entry| entry.0 == name).ok_or_else(unknown)?;
        for (name, field) in entry.1 {
            field.set(servo, number(name).ok_or_else(unknown)?);
        }
        if servo.goal_range[0] >= servo.goal_range[1] {
            return Err(unknown());
        }
    }
    Ok(())
}

fn as_number(value: &toml::Value) -> Option<f64> {
    let whole = value.as_integer().map(|number| number as f64);
    value.as_float().or(whole).filter(|number| number.is_finite())
}
