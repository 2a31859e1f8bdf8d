//! `[joint.standard_error]` from TOML.

use super::drive::StandardErrors;
use super::joint::ArmJoint;
use super::units::Units;
use crate::error::{FileError, Problem};
use crate::section::Section;

/// The standard errors of a joint's values, under the names that are written.
///
/// A vector's may be one number for all its components.
pub(super) fn read_standard_errors(
    table: Section,
    joint: &ArmJoint,
    units: Units,
) -> Result<StandardErrors, FileError> {
    let mut errors = StandardErrors::new();
    for (names, components) in values_of(joint, units) {
        for name in &names {
            let Some(found) = table.list(name)? else { continue };
            let found = fitting(&table, name, found, components)?;
            errors.insert(names[0].clone(), found);
        }
    }
    table.finish()?;
    Ok(errors)
}

/// The values that a joint may have, each with the names it may stand under and how many components
/// it has, 0 where the joint lacks it.
fn values_of(joint: &ArmJoint, units: Units) -> Vec<(Vec<String>, usize)> {
    let (link, drive) = (&joint.link, joint.drive.as_ref());
    let one = |value: Option<f64>| usize::from(value.is_some());
    let mut values = vec![
        (vec!["origin_xyz_m".to_owned()], 3),
        (vec!["origin_rpy_rad".to_owned()], 3),
        (vec!["axis".to_owned()], 3),
        (vec!["mass_kg".to_owned()], one(link.mass_kg)),
        (vec!["com_m".to_owned()], link.com_m.map_or(0, |_| 3)),
        (vec!["inertia_kg_m2".to_owned()], link.inertia_kg_m2.map_or(0, |_| 6)),
        (vec![units.armature()], one(joint.armature)),
        (vec!["gear_ratio".to_owned()], usize::from(drive.is_some())),
    ];
    let of_drive = drive.map(|d| [d.torque_constant, d.stiffness, d.damping, d.limit]);
    let of_drive = units.drive().into_iter().zip(of_drive.unwrap_or_default());
    values.extend(of_drive.map(|(name, value)| (vec![name], one(value))));
    let names = units.of_friction().map(|units| units.friction());
    let f = joint.friction.unwrap_or_default();
    let of_friction = [f.alpha0, f.alpha1, f.stribeck_velocity, f.alpha2, f.sigma0, f.sigma1];
    values.extend((0..6).map(|index| {
        let names = names.iter().map(|names| names[index].clone()).collect();
        (names, one(of_friction[index]))
    }));
    values
}

fn fitting(
    table: &Section,
    name: &str,
    found: Vec<f64>,
    components: usize,
) -> Result<Vec<f64>, FileError> {
    let what = match found.as_slice() {
        _ if components == 0 => format!("{name} has a standard error, but no value"),
        values if values.iter().any(|error| *error < 0.0) => {
            format!("the standard error of {name} is below 0")
        }
        [one] => return Ok(vec![*one; components]),
        values if values.len() == components => return Ok(found),
        values => format!(
            "the standard error of {name} has {} numbers, but must have 1 or {components}",
            values.len()
        ),
    };
    Err(table.problem(name, Problem::Contradiction(what)))
}
