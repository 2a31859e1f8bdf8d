//! Arms of any kind to TOML.

use std::io::Write;
use std::path::Path;

use model::mechanism::JointKind;
use toml::{Table, Value};

use super::arm::{ArmFile, BASE};
use super::drive::{ArmFriction, Drive, Encoder, EncoderSide};
use super::joint::ArmJoint;
use super::read_drive::{DRIVE_KINDS, SIDES};
use super::read_joint::units_of;
use super::units::Units;
use crate::error::{FileError, Problem};
use crate::replace::replace_file;
use crate::toml_source::ARM_FORMAT;

impl ArmFile {
    /// Writes a file, whole or not at all; what came from a URDF is written out.
    ///
    /// # Errors
    /// The path cannot be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), FileError> {
        let path = path.as_ref();
        let text = self.to_toml().map_err(|problem| problem.in_file(path))?;
        replace_file(path, |out| out.write_all(text.as_bytes()).map_err(Problem::Unwritable))
    }

    /// The file's text.
    ///
    /// # Errors
    /// A value that TOML cannot hold.
    pub fn to_toml(&self) -> Result<String, Problem> {
        self.text().map_err(|error| Problem::Toml(error.to_string()))
    }

    fn text(&self) -> Result<String, toml::ser::Error> {
        let joints: Vec<Value> = self.joints.iter().map(|j| Value::Table(of_joint(j))).collect();
        let mut sections = vec![
            toml::to_string(&Table::from_iter([("format".to_owned(), ARM_FORMAT.into())]))?,
            toml::to_string(&Table::from_iter([("robot".to_owned(), self.robot())]))?,
            toml::to_string(&Table::from_iter([("joint".to_owned(), joints.into())]))?,
        ];
        if !self.effects.is_empty() {
            let effects = Value::try_from(&self.effects)?;
            sections.push(toml::to_string(&Table::from_iter([("effect".to_owned(), effects)]))?);
        }
        if !self.base_errors.is_empty() {
            let errors = Value::try_from(&self.base_errors)?;
            sections.push(toml::to_string(&Table::from_iter([(BASE.to_owned(), errors)]))?);
        }
        Ok(sections.join("\n"))
    }

    fn robot(&self) -> Value {
        let mut table = Table::new();
        put(&mut table, "name", self.name.clone());
        put(&mut table, "gravity_m_s2", Some(self.gravity_m_s2.to_vec()));
        put(&mut table, "sample_period_s", self.sample_period_s);
        Value::Table(table)
    }
}

fn put(table: &mut Table, name: &str, value: Option<impl Into<Value>>) {
    if let Some(value) = value {
        table.insert(name.to_owned(), value.into());
    }
}

fn of_joint(joint: &ArmJoint) -> Table {
    let (units, link) = (units_of(joint), &joint.link);
    let kind = match joint.kind {
        JointKind::Revolute => "revolute",
        JointKind::Prismatic => "prismatic",
    };
    let mut table = Table::new();
    put(&mut table, "name", joint.name.clone());
    put(&mut table, "kind", Some(kind));
    put(&mut table, "origin_xyz_m", Some(joint.origin_xyz_m.to_vec()));
    put(&mut table, "origin_rpy_rad", Some(joint.origin_rpy_rad.to_vec()));
    put(&mut table, "axis", Some(joint.axis.to_vec()));
    put(&mut table, "mass_kg", link.mass_kg);
    put(&mut table, "com_m", link.com_m.map(|x| x.to_vec()));
    put(&mut table, "inertia_kg_m2", link.inertia_kg_m2.map(|x| x.to_vec()));
    put(&mut table, &units.armature(), joint.armature);
    put(&mut table, &units.limits(), joint.limits.map(|x| x.to_vec()));
    put(&mut table, "drive", joint.drive.as_ref().map(|drive| of_drive(drive, units)));
    put(&mut table, "encoder", joint.encoder.map(|encoder| of_encoder(encoder, joint.kind)));
    put(&mut table, "friction", joint.friction.map(|friction| of_friction(&friction, units)));
    put(&mut table, "standard_error", of_errors(joint));
    table
}

fn of_drive(drive: &Drive, units: Units) -> Table {
    let [constant, stiffness, damping, limit] = units.drive();
    let kind = DRIVE_KINDS.iter().find(|(_, kind)| *kind == drive.kind).map(|(name, _)| *name);
    let mut table = Table::new();
    put(&mut table, "kind", kind);
    put(&mut table, &constant, drive.torque_constant);
    put(&mut table, "gear_ratio", Some(drive.gear_ratio));
    put(&mut table, &stiffness, drive.stiffness);
    put(&mut table, &damping, drive.damping);
    put(&mut table, &limit, drive.limit);
    table
}

fn of_encoder(encoder: Encoder, joint: JointKind) -> Table {
    let by_metre = joint == JointKind::Prismatic && encoder.side == EncoderSide::Joint;
    let side = SIDES.iter().find(|(_, side)| *side == encoder.side).map(|(name, _)| *name);
    let mut table = Table::new();
    put(&mut table, if by_metre { "counts_per_m" } else { "counts_per_rev" }, Some(encoder.counts));
    put(&mut table, "side", side);
    table
}

fn of_friction(friction: &ArmFriction, units: Units) -> Table {
    let f = friction;
    let values = [f.alpha0, f.alpha1, f.stribeck_velocity, f.alpha2, f.sigma0, f.sigma1];
    let mut table = Table::new();
    for (name, value) in units.of_friction()[0].friction().iter().zip(values) {
        put(&mut table, name, value);
    }
    table
}

/// A vector whose errors are all alike is written in full all the same.
fn of_errors(joint: &ArmJoint) -> Option<Table> {
    let value = |errors: &Vec<f64>| match errors.as_slice() {
        [one] => Value::from(*one),
        several => Value::from(several.to_vec()),
    };
    let errors = joint.standard_error.iter().map(|(name, errors)| (name.clone(), value(errors)));
    (!joint.standard_error.is_empty()).then(|| errors.collect())
}
