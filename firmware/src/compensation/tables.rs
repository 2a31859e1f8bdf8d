//! Curves over one axis that are taken off the command.

use heapless::Vec;
use serde::{Deserialize, Serialize};

/// Room for tables, per joint.
pub const MAX_TABLES: usize = 2;
/// Room for knots, per table: six full tables fill the block up.
pub const MAX_KNOTS: usize = 20;

/// A curve that the motor finds added to its voltage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// Over what the curve lies.
    pub axis: TableAxis,
    /// Where it is known, increasing, in the unit of the axis.
    pub knots: Vec<f32, MAX_KNOTS>,
    /// What it adds there [V]; linear between the knots, constant beyond the ends.
    pub values_v: Vec<f32, MAX_KNOTS>,
}

/// What a curve can lie over that the reference tells. The board does not compensate curves over
/// the command, which it would have to know before it has computed it, or over time, whose zero is
/// not the board's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum TableAxis {
    /// Angle of the joint, turns included [rad].
    Position,
    /// Velocity of the joint [rad/s].
    Velocity,
    /// Coriolis and gravity torque on the joint, c + h [Nm].
    Load,
}
