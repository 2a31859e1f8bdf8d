//! What a file says of a joint.

use model::chain::{Body, Joint, Transform, rotation_of_rpy};
use model::mechanism::JointKind;

use super::drive::{ArmFriction, Drive, Encoder, StandardErrors};
use super::units::Units;

/// The rigid body that a joint moves; absent values are unknown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinkTable {
    /// Mass [kg].
    pub mass_kg: Option<f64>,
    /// Centre of mass in the joint's frame [m].
    pub com_m: Option<[f64; 3]>,
    /// Inertia about the centre of mass, ixx ixy ixz iyy iyz izz [kg m^2].
    pub inertia_kg_m2: Option<[f64; 6]>,
}

/// `[[joint]]`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ArmJoint {
    /// The joint's name.
    pub name: Option<String>,
    /// What the joint does.
    pub kind: JointKind,
    /// Origin of the joint's frame in that of the link before [m].
    pub origin_xyz_m: [f64; 3],
    /// Roll, pitch and yaw of that frame [rad].
    pub origin_rpy_rad: [f64; 3],
    /// The axis in the joint's frame.
    pub axis: [f64; 3],
    /// The link that the joint moves.
    pub link: LinkTable,
    /// The rotor, seen at the joint [kg m^2; kg].
    pub armature: Option<f64>,
    /// Lower and upper end of its range [rad; m].
    pub limits: Option<[f64; 2]>,
    /// Its drive.
    pub drive: Option<Drive>,
    /// Its encoder.
    pub encoder: Option<Encoder>,
    /// Its friction.
    pub friction: Option<ArmFriction>,
    /// Standard errors by the names of the values; a value without one is exact.
    pub standard_error: StandardErrors,
}

impl ArmJoint {
    /// Whether the link's ten numbers are all known.
    pub fn is_link_known(&self) -> bool {
        let LinkTable { mass_kg, com_m, inertia_kg_m2 } = self.link;
        mass_kg.is_some() && com_m.is_some() && inertia_kg_m2.is_some()
    }

    /// The standard error of a value by its name in the file; `None` where it is exact.
    pub fn standard_error(&self, name: &str) -> Option<&[f64]> {
        self.standard_error.get(name).map(Vec::as_slice)
    }

    /// One count of its encoder as a position of the joint [rad; m]; `None` without an encoder.
    pub fn count_step(&self) -> Option<f64> {
        let gear_ratio = self.drive.as_ref().map_or(1.0, |drive| drive.gear_ratio);
        Some(self.encoder?.step(gear_ratio, self.kind == JointKind::Prismatic))
    }

    /// The name of its rotor's inertia in a file, `armature_kg_m2` or `armature_kg`.
    pub fn armature_name(&self) -> String {
        self.units().armature()
    }

    /// The names of friction's six values in a file, as they are written.
    pub fn friction_names(&self) -> [String; 6] {
        self.units().of_friction()[0].friction()
    }

    /// The unit of its command: `V`, `A`, `Nm` or `N`.
    pub fn command_unit(&self) -> &'static str {
        self.units().command
    }

    /// The unit of its position: `rad` or `m`.
    pub fn position_unit(&self) -> &'static str {
        self.units().position
    }

    fn units(&self) -> Units {
        let drive = self.drive.as_ref().map(|drive| drive.kind);
        Units::of(self.kind, drive.unwrap_or_default())
    }

    /// The joint of a chain; what is unknown of the link is zero.
    pub(super) fn of_chain(&self) -> Joint<f64> {
        let LinkTable { mass_kg, com_m, inertia_kg_m2 } = self.link;
        let rotation = rotation_of_rpy(self.origin_rpy_rad);
        Joint {
            kind: self.kind,
            origin: Transform { rotation, position: self.origin_xyz_m },
            axis: self.axis,
            body: Body::about_centre(
                mass_kg.unwrap_or(0.0),
                com_m.unwrap_or_default(),
                inertia_kg_m2.unwrap_or_default(),
            ),
            armature: self.armature.unwrap_or(0.0),
        }
    }
}
