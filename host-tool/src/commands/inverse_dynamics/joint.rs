//! The columns of a joint.

use files::ArmJoint;
use files::arm_file::DriveKind;
use model::mechanism::JointKind;

/// A joint's number and units, and the torque by its command.
#[derive(Clone, Debug)]
pub struct JointColumns {
    number: usize,
    kind: JointKind,
    /// The command's unit, and the torque by it, where both are known.
    command: Option<(&'static str, f64)>,
}

impl JointColumns {
    /// A joint of the robot of format 1, which is commanded a voltage; torque constant in Nm/V.
    pub fn with_voltage(number: u8, torque_constant_nm_per_v: f64) -> Self {
        let command = Some(("V", torque_constant_nm_per_v));
        Self { number: number.into(), kind: JointKind::Revolute, command }
    }

    /// A joint of an arm of any kind, its number from 1.
    pub fn of(number: usize, joint: &ArmJoint) -> Self {
        let command = joint.drive.as_ref().and_then(|drive| match drive.kind {
            DriveKind::Voltage => Some(("V", drive.torque_constant?)),
            DriveKind::Current => Some(("A", drive.torque_constant?)),
            // A torque is its own command, a servo's is a goal.
            DriveKind::Torque | DriveKind::PositionServo => None,
        });
        Self { number, kind: joint.kind, command }
    }

    /// Position, velocity and acceleration.
    pub fn motion(&self) -> [String; 3] {
        let (joint, unit) = (self.number, self.unit());
        [
            format!("q{joint}_{unit}"),
            format!("qd{joint}_{unit}_per_s"),
            format!("qdd{joint}_{unit}_per_s2"),
        ]
    }

    /// Torque or force.
    pub fn torque(&self) -> String {
        let unit = match self.kind {
            JointKind::Revolute => "Nm",
            JointKind::Prismatic => "N",
        };
        format!("tau{}_{unit}", self.number)
    }

    /// The command, where it is neither torque nor goal.
    pub fn command(&self) -> Option<String> {
        self.command.map(|(unit, _)| format!("u{}_{unit}", self.number))
    }

    /// Torque by command.
    pub fn torque_constant(&self) -> Option<f64> {
        self.command.map(|(_, constant)| constant)
    }

    fn unit(&self) -> &'static str {
        match self.kind {
            JointKind::Revolute => "rad",
            JointKind::Prismatic => "m",
        }
    }
}
