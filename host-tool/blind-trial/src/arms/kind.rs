//! The kinds of arms that are tried.

use files::ArmFile;
use files::example_arms::{linear_axis, rotary_joint, six_axes, two_link_pendulum};
use serde::Serialize;

/// A kind of arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum ArmKind {
    /// One joint that turns against gravity, voltages.
    RotaryJoint,
    /// One joint that slides, forces.
    LinearJoint,
    /// A pendulum of two links, voltages.
    TwoLinkPendulum,
    /// Six joints with gears, currents, encoders on the motors.
    SixAxes,
    /// Six position servos at 50 Hz.
    SixServos,
}

impl ArmKind {
    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::RotaryJoint => "rotary-joint",
            Self::LinearJoint => "linear-joint",
            Self::TwoLinkPendulum => "two-link-pendulum",
            Self::SixAxes => "six-axes",
            Self::SixServos => "six-servos",
        }
    }

    /// Whether its drives take goals.
    pub fn is_of_servos(self) -> bool {
        self == Self::SixServos
    }

    /// The model that the diagnosis gets.
    pub fn nominal(self) -> ArmFile {
        /// Any: the truth is drawn about it.
        const SEED: u64 = 1;
        match self {
            Self::RotaryJoint => rotary_joint(),
            Self::LinearJoint => linear_axis(),
            Self::TwoLinkPendulum => two_link_pendulum(),
            Self::SixAxes => six_axes(),
            Self::SixServos => servo::synthetic::six_axes(SEED),
        }
    }
}
