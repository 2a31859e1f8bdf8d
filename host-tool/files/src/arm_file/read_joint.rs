//! `[[joint]]` from TOML.

use model::mechanism::JointKind;

use super::drive::{Drive, DriveKind};
use super::joint::{ArmJoint, LinkTable};
use super::read_drive::{read_drive, read_encoder, read_friction, require};
use super::standard_errors::read_standard_errors;
use super::units::Units;
use crate::error::{FileError, Problem};
use crate::robot_file::LONGEST_LINK_M;
use crate::section::Section;

const KINDS: [(&str, JointKind); 2] =
    [("revolute", JointKind::Revolute), ("prismatic", JointKind::Prismatic)];

/// No joint has a range beyond [rad; m].
const FURTHEST: f64 = 1000.0;

/// A joint, with what a URDF says of it where the table does not.
pub(super) fn read_joint(table: &Section, urdf: Option<&ArmJoint>) -> Result<ArmJoint, FileError> {
    let mut joint = urdf.cloned().unwrap_or_default();
    joint.name = table.text("name")?.or(joint.name);
    read_geometry(table, &mut joint, urdf.is_some())?;
    read_link(table, &mut joint.link)?;
    let drive = table.section("drive", &format!("drive of {}", table.name()))?;
    joint.drive = drive.map(|drive| read_drive(drive, joint.kind)).transpose()?;
    let units = units_of(&joint);
    read_rotor_and_limits(table, &mut joint, units)?;
    let encoder = table.section("encoder", &format!("encoder of {}", table.name()))?;
    joint.encoder = encoder.map(|encoder| read_encoder(encoder, joint.kind)).transpose()?;
    let friction = table.section("friction", &format!("friction of {}", table.name()))?;
    joint.friction = friction.map(|friction| read_friction(friction, units)).transpose()?;
    let errors = table.section("standard_error", &format!("standard_error of {}", table.name()))?;
    if let Some(errors) = errors {
        joint.standard_error = read_standard_errors(errors, &joint, units)?;
    }
    Ok(joint)
}

/// The units in the names of a joint's values.
pub(super) fn units_of(joint: &ArmJoint) -> Units {
    let drive = joint.drive.as_ref().map(|drive: &Drive| drive.kind);
    Units::of(joint.kind, drive.unwrap_or(DriveKind::Voltage))
}

fn read_geometry(
    table: &Section,
    joint: &mut ArmJoint,
    is_from_urdf: bool,
) -> Result<(), FileError> {
    match table.word("kind", &KINDS)? {
        Some(kind) if is_from_urdf && kind != joint.kind => {
            let what = "kind is not that of the URDF's joint".to_owned();
            return Err(table.problem("kind", Problem::Contradiction(what)));
        }
        Some(kind) => joint.kind = kind,
        None if is_from_urdf => {}
        None => return Err(missing(table, "kind")),
    }
    joint.origin_xyz_m = table.numbers("origin_xyz_m")?.unwrap_or(joint.origin_xyz_m);
    require_length(table, "origin_xyz_m", joint.origin_xyz_m)?;
    joint.origin_rpy_rad = table.numbers("origin_rpy_rad")?.unwrap_or(joint.origin_rpy_rad);
    let turned = largest(joint.origin_rpy_rad);
    require(table, "origin_rpy_rad", Some(turned), IN_RADIANS, |angle| angle <= FULL_TURN_RAD)?;
    match table.numbers::<3>("axis")? {
        Some(axis) => joint.axis = axis,
        None if is_from_urdf => {}
        None => return Err(missing(table, "axis")),
    }
    let length = joint.axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    // Beyond these the square is no number.
    if !(1e-100..1e100).contains(&length) {
        let what = format!("axis is {:?}, but must have a direction", joint.axis);
        return Err(table.problem("axis", Problem::Contradiction(what)));
    }
    Ok(())
}

/// Angles of frames end after a turn; what is beyond was meant in degrees.
const FULL_TURN_RAD: f64 = 6.3;
const IN_RADIANS: &str = "be within a turn either way: angles are in radians";

fn largest(values: [f64; 3]) -> f64 {
    values.into_iter().map(f64::abs).fold(0.0, f64::max)
}

fn require_length(table: &Section, name: &str, values: [f64; 3]) -> Result<(), FileError> {
    let must = "be within 10 m either way: lengths are in metres";
    require(table, name, Some(largest(values)), must, |length| length <= LONGEST_LINK_M)
}

fn read_link(table: &Section, link: &mut LinkTable) -> Result<(), FileError> {
    link.mass_kg = table.number("mass_kg")?.or(link.mass_kg);
    link.com_m = table.numbers("com_m")?.or(link.com_m);
    link.inertia_kg_m2 = table.numbers("inertia_kg_m2")?.or(link.inertia_kg_m2);
    require(table, "mass_kg", link.mass_kg, "be 0 or more", |mass| mass >= 0.0)?;
    require_length(table, "com_m", link.com_m.unwrap_or_default())?;
    let moments = link.inertia_kg_m2.map(|[xx, _, _, yy, _, zz]| xx.min(yy).min(zz));
    require(table, "inertia_kg_m2", moments, "have no moment ixx, iyy, izz below 0", |i| i >= 0.0)
}

fn read_rotor_and_limits(
    table: &Section,
    joint: &mut ArmJoint,
    units: Units,
) -> Result<(), FileError> {
    let (armature, limits) = (units.armature(), units.limits());
    joint.armature = table.number(&armature)?.or(joint.armature);
    require(table, &armature, joint.armature, "be 0 or more", |armature| armature >= 0.0)?;
    joint.limits = table.numbers(&limits)?.or(joint.limits);
    match joint.limits {
        Some([lower, upper])
            if !(lower < upper && lower.abs() <= FURTHEST && upper.abs() <= FURTHEST) =>
        {
            let what = format!(
                "{limits} is [{lower}, {upper}], but must be [lower, upper], at most 1000 either way"
            );
            Err(table.problem(&limits, Problem::Contradiction(what)))
        }
        _ => Ok(()),
    }
}

fn missing(table: &Section, name: &str) -> FileError {
    let what = format!("{name} in {}", table.name());
    table.problem(name, Problem::MissingParameter(what))
}
