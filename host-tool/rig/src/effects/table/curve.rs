//! The curve of a table, and whether it is one.

use firmware::compensation::limits::{self, Bounds};

use super::axis::TableAxis;
use super::names::{KNOTS, NAME, VALUES_V};
use crate::effects::definition::BOARD_JOINTS;
use crate::effects::effect::JointState;
use crate::effects::error::EffectError;

/// The fewest knots that make a curve.
pub const FEWEST_TABLE_KNOTS: usize = 2;
/// The most knots of a table: as fine as any remainder is known, and still read at a glance.
pub const MAX_TABLE_KNOTS: usize = 64;

/// A curve over one axis that is added to the voltage of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Joint, from 1.
    pub joint: u8,
    /// Over what the curve lies.
    pub axis: TableAxis,
    /// Where it is known, increasing, in the unit of the axis.
    pub knots: Vec<f64>,
    /// What it adds there [V].
    pub values_v: Vec<f64>,
}

impl Table {
    /// The curve at `x`, in the unit of the axis [V]: linear between the knots, constant beyond
    /// the first and the last.
    pub fn value_v(&self, x: f64) -> f64 {
        model::effects::table_v(&self.knots, &self.values_v, x)
    }

    /// Where on the axis its joint is; `command_v` is the command as it reaches the joint's
    /// motor [V].
    pub fn abscissa(&self, state: &JointState, command_v: f64) -> f64 {
        let joint = self.index();
        match self.axis {
            TableAxis::Position => state.q_rad[joint],
            TableAxis::Velocity => state.qd_rad_per_s[joint],
            TableAxis::Load => state.load_nm[joint],
            TableAxis::Command => command_v,
            TableAxis::Time => state.time_s,
        }
    }

    /// Its joint as an index.
    pub(super) fn index(&self) -> usize {
        usize::from(self.joint.max(1)) - 1
    }

    /// The same table, if it is one.
    ///
    /// # Errors
    /// A joint that is none, knots that do not increase or are out of bounds, values out of
    /// bounds, or not as many of them as knots.
    pub fn checked(self) -> Result<Self, EffectError> {
        self.checked_on_one_of(BOARD_JOINTS)
    }

    /// The same on an arm of so many joints.
    pub(super) fn checked_on_one_of(self, joints: u8) -> Result<Self, EffectError> {
        if !(1..=joints).contains(&self.joint) {
            let right = match joints {
                BOARD_JOINTS => "joint 1, 2 or 3",
                _ => "a joint of the arm",
            };
            return Err(EffectError::Joint { effect: NAME, right, joint: self.joint });
        }
        let (knots, values) = (self.knots.len(), self.values_v.len());
        if knots != values || !(FEWEST_TABLE_KNOTS..=MAX_TABLE_KNOTS).contains(&knots) {
            let (fewest, most) = (FEWEST_TABLE_KNOTS, MAX_TABLE_KNOTS);
            return Err(EffectError::TableLength { knots, values, fewest, most });
        }
        all_within(KNOTS, &self.knots, limits::TABLE_KNOT)?;
        all_within(VALUES_V, &self.values_v, limits::TABLE_V)?;
        match self.knots.windows(2).find(|pair| pair[0] >= pair[1]) {
            Some(pair) => Err(EffectError::TableOrder { before: pair[0], next: pair[1] }),
            None => Ok(self),
        }
    }
}

fn all_within(parameter: &'static str, values: &[f64], bounds: Bounds) -> Result<(), EffectError> {
    let Bounds { lowest, highest, .. } = bounds;
    match values.iter().find(|value| !(lowest..=highest).contains(*value)) {
        Some(&value) => Err(EffectError::Value { effect: NAME, parameter, value, lowest, highest }),
        None => Ok(()),
    }
}
