//! Over what a table lies.

use serde::{Deserialize, Serialize};

/// Over what the curve of a table lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TableAxis {
    /// Angle of the joint as its encoder sees it, turns included [rad].
    Position,
    /// Velocity of the joint [rad/s].
    Velocity,
    /// Coriolis and gravity torque on the joint, c + h of eq. (5) [Nm].
    Load,
    /// The command as it reaches the motor [V].
    Command,
    /// Time since the log began [s].
    Time,
}

impl TableAxis {
    /// All axes, in the order in which messages list them.
    pub const ALL: [Self; 5] =
        [Self::Position, Self::Velocity, Self::Load, Self::Command, Self::Time];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
            Self::Load => "load",
            Self::Command => "command",
            Self::Time => "time",
        }
    }

    /// The unit of its knots.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Position => "rad",
            Self::Velocity => "rad/s",
            Self::Load => "Nm",
            Self::Command => "V",
            Self::Time => "s",
        }
    }

    /// The axis of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|axis| axis.name() == name)
    }
}
