//! Names of values, whose units depend on what a joint does and what its drive is commanded.

use model::mechanism::JointKind;

use super::drive::DriveKind;

/// The units in the names of a joint's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Units {
    /// `rad` or `m`.
    pub(super) position: &'static str,
    /// `Nm` or `N`.
    pub(super) torque: &'static str,
    /// `kg_m2` or `kg`.
    pub(super) inertia: &'static str,
    /// `V`, `A`, `Nm` or `N`.
    pub(super) command: &'static str,
}

impl Units {
    pub(super) fn of(joint: JointKind, drive: DriveKind) -> Self {
        let (position, torque, inertia) = match joint {
            JointKind::Revolute => ("rad", "Nm", "kg_m2"),
            JointKind::Prismatic => ("m", "N", "kg"),
        };
        let command = match drive {
            DriveKind::Voltage | DriveKind::PositionServo => "V",
            DriveKind::Current => "A",
            DriveKind::Torque => torque,
        };
        Self { position, torque, inertia, command }
    }

    /// The rotor's inertia.
    pub(super) fn armature(&self) -> String {
        format!("armature_{}", self.inertia)
    }

    /// The ends of the range.
    pub(super) fn limits(&self) -> String {
        format!("limits_{}", self.position)
    }

    /// The values of a drive: torque constant, stiffness, damping, limit.
    pub(super) fn drive(&self) -> [String; 4] {
        let Self { position, torque, command, .. } = self;
        [
            format!("torque_constant_{torque}_per_{command}"),
            format!("stiffness_V_per_{position}"),
            format!("damping_V_s_per_{position}"),
            format!("limit_{command}"),
        ]
    }

    /// The six values of friction: V stands for the unit of whatever the command is.
    pub(super) fn friction(&self) -> [String; 6] {
        let Self { position, command, .. } = self;
        [
            format!("alpha0_{command}"),
            format!("alpha1_{command}"),
            format!("stribeck_velocity_{position}_per_s"),
            format!("alpha2_{command}_s_per_{position}"),
            format!("sigma0_{command}_per_{position}"),
            format!("sigma1_{command}_s_per_{position}"),
        ]
    }

    /// The units of friction's names: those written, then others under which they may stand.
    pub(super) fn of_friction(&self) -> [Self; 4] {
        let volts = Self { command: "V", ..*self };
        [volts, *self, Self { position: "rad", ..volts }, Self { position: "rad", ..*self }]
    }
}
