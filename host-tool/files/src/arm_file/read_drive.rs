//! A joint's drive, encoder and friction from TOML.

use model::mechanism::JointKind;

use super::drive::{ArmFriction, Drive, DriveKind, Encoder, EncoderSide};
use super::units::Units;
use crate::error::{FileError, Problem};
use crate::section::Section;

/// The kinds of drives by name.
pub(super) const DRIVE_KINDS: [(&str, DriveKind); 4] = [
    ("voltage", DriveKind::Voltage),
    ("torque", DriveKind::Torque),
    ("current", DriveKind::Current),
    ("position-servo", DriveKind::PositionServo),
];

/// The sides of encoders by name.
pub(super) const SIDES: [(&str, EncoderSide); 2] =
    [("joint", EncoderSide::Joint), ("motor", EncoderSide::Motor)];

/// `[joint.drive]`.
pub(super) fn read_drive(table: Section, joint: JointKind) -> Result<Drive, FileError> {
    let kind = table.word("kind", &DRIVE_KINDS)?.unwrap_or_default();
    let [constant, stiffness, damping, limit] = Units::of(joint, kind).drive();
    let gear_ratio = table.number("gear_ratio")?.unwrap_or(1.0);
    let is_servo = kind == DriveKind::PositionServo;
    let when = |wanted: bool, name: &str| if wanted { table.number(name) } else { Ok(None) };
    let drive = Drive {
        kind,
        torque_constant: when(kind != DriveKind::Torque, &constant)?,
        gear_ratio,
        stiffness: when(is_servo, &stiffness)?,
        damping: when(is_servo, &damping)?,
        limit: table.number(&limit)?,
    };
    let positive = |name: &str, value| require(&table, name, value, "be above 0", |x| x > 0.0);
    positive(&constant, drive.torque_constant)?;
    positive(&stiffness, drive.stiffness)?;
    positive(&limit, drive.limit)?;
    require(&table, "gear_ratio", Some(gear_ratio), "not be 0", |ratio| ratio != 0.0)?;
    require(&table, &damping, drive.damping, "be 0 or more", |damping| damping >= 0.0)?;
    table.finish()?;
    Ok(drive)
}

/// `[joint.encoder]`.
pub(super) fn read_encoder(table: Section, joint: JointKind) -> Result<Encoder, FileError> {
    let side = table.word("side", &SIDES)?.unwrap_or_default();
    let by_metre = joint == JointKind::Prismatic && side == EncoderSide::Joint;
    let name = if by_metre { "counts_per_m" } else { "counts_per_rev" };
    let Some(counts) = table.number(name)? else {
        let what = format!("{name} in {}", table.name());
        return Err(table.problem(name, Problem::MissingParameter(what)));
    };
    require(&table, name, Some(counts), "be above 0", |counts| counts > 0.0)?;
    table.finish()?;
    Ok(Encoder { counts, side })
}

/// `[joint.friction]`.
pub(super) fn read_friction(table: Section, units: Units) -> Result<ArmFriction, FileError> {
    let mut values = [None; 6];
    for names in units.of_friction().map(|units| units.friction()) {
        for (value, name) in values.iter_mut().zip(&names) {
            *value = value.map_or_else(|| table.number(name), |value| Ok(Some(value)))?;
        }
    }
    let [alpha0, alpha1, stribeck_velocity, alpha2, sigma0, sigma1] = values;
    let [coulomb, _, velocity, _, stiffness, damping] = units.of_friction()[0].friction();
    require(&table, &coulomb, alpha0, "be 0 or more", |level| level >= 0.0)?;
    require(&table, &velocity, stribeck_velocity, "be above 0", |velocity| velocity > 0.0)?;
    require(&table, &stiffness, sigma0, "be above 0", |stiffness| stiffness > 0.0)?;
    require(&table, &damping, sigma1, "be 0 or more", |damping| damping >= 0.0)?;
    table.finish()?;
    Ok(ArmFriction { alpha0, alpha1, stribeck_velocity, alpha2, sigma0, sigma1 })
}

/// Refuses a value that is there and does not hold.
pub(super) fn require(
    table: &Section,
    name: &str,
    value: Option<f64>,
    must: &str,
    holds: impl Fn(f64) -> bool,
) -> Result<(), FileError> {
    match value {
        Some(value) if !holds(value) => {
            let what = format!("{name} in {} is {value}, but must {must}", table.name());
            Err(table.problem(name, Problem::OutOfRange(what)))
        }
        _ => Ok(()),
    }
}
