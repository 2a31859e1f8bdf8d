//! The names of a joint's columns.

use model::mechanism::JointKind;

use crate::arm_file::{ArmJoint, DriveKind};

/// Columns of a joint, in the units of its kind and drive.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Columns {
    pub(super) position: String,
    pub(super) count: String,
    pub(super) reference: String,
    pub(super) velocity: String,
    pub(super) torque: String,
    /// The command; `reference` for a position servo.
    pub(super) command: String,
    /// Commands of other drives, which would be a mistake.
    pub(super) others: Vec<String>,
}

impl Columns {
    /// Those of a joint, its number from 1.
    pub(super) fn of(number: usize, joint: &ArmJoint) -> Self {
        let (unit, torque) = match joint.kind {
            JointKind::Revolute => ("rad", "Nm"),
            JointKind::Prismatic => ("m", "N"),
        };
        let drive = joint.drive.as_ref().map(|drive| drive.kind).unwrap_or_default();
        let reference = format!("qref{number}_{unit}");
        let command = match drive {
            DriveKind::Voltage => format!("u{number}_V"),
            DriveKind::Current => format!("u{number}_A"),
            DriveKind::Torque => format!("u{number}_{torque}"),
            DriveKind::PositionServo => reference.clone(),
        };
        let all = ["V", "A", "Nm", "N"].map(|unit| format!("u{number}_{unit}"));
        Self {
            position: format!("q{number}_{unit}"),
            count: format!("q{number}_count"),
            velocity: format!("qd{number}_{unit}_per_s"),
            torque: format!("tau{number}_{torque}"),
            others: all.into_iter().filter(|name| *name != command).collect(),
            command,
            reference,
        }
    }

    /// Whether a column of the joint is read.
    pub(super) fn has(&self, name: &str) -> bool {
        let Self { position, reference, velocity, torque, command, .. } = self;
        [position, reference, velocity, torque, command].iter().any(|column| *column == name)
    }
}
