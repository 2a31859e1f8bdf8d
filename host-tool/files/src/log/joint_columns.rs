//! A joint's columns as its messages have them: angles, and what follows from them.

use std::f64::consts::TAU;

use super::channel::Channel;
use super::joint_message::{CountMessage, JointMessage, count_topic, schema, topic};
use super::{JointLog, Position};

/// Steps to which what was computed is rounded [rad; rad/s]: below any encoder's, and digits that say
/// nothing do not compress.
const ANGLE_STEP_RAD: f64 = 1e-9;
const VELOCITY_STEP_RAD_PER_S: f64 = 1e-6;

/// The columns of one joint.
pub(super) struct JointColumns<'a> {
    joint: &'a JointLog,
    /// Angles; none where counts per turn are not known.
    position_rad: Option<Vec<f64>>,
    velocity_rad_per_s: Option<Vec<f64>>,
    error_rad: Option<Vec<f64>>,
}

impl<'a> JointColumns<'a> {
    pub(super) fn of(joint: &'a JointLog, time_s: &[f64], counts_per_rev: Option<f64>) -> Self {
        let position_rad = match &joint.position {
            Position::Radian(angles) => Some(angles.clone()),
            counts => counts_per_rev.map(|per_rev| {
                counts.radians(per_rev).into_iter().map(|q| rounded(q, ANGLE_STEP_RAD)).collect()
            }),
        };
        let velocity_rad_per_s = position_rad.as_ref().map(|q| velocity(time_s, q));
        let error_rad = position_rad.as_ref().zip(joint.reference_rad.as_ref());
        let error_rad = error_rad.map(|(q, reference)| {
            reference.iter().zip(q).map(|(reference, q)| error(reference - q)).collect()
        });
        Self { joint, position_rad, velocity_rad_per_s, error_rad }
    }

    /// Whether counts have a channel of their own, beside the angles.
    pub(super) fn has_count_channel(&self) -> bool {
        self.position_rad.is_some() && matches!(self.joint.position, Position::Count(_))
    }

    /// The channels of the joint: its samples, and its counts where they have one of their own. There
    /// must be a row.
    pub(super) fn channels(&self, time_s: f64) -> Vec<Channel> {
        let number = self.joint.joint;
        let samples = Channel {
            topic: topic(number),
            schema_name: format!("Joint{number}Sample"),
            schema: schema(&format!("Joint {number} sample"), &self.message(0, time_s)),
        };
        let counts = self.count_message(0, time_s).map(|message| Channel {
            topic: count_topic(number),
            schema_name: format!("Joint{number}Count"),
            schema: schema(&format!("Joint {number} counts"), &message),
        });
        std::iter::once(samples).chain(counts).collect()
    }

    /// The message of a row.
    pub(super) fn message(&self, row: usize, time_s: f64) -> JointMessage {
        let at = |values: &Option<Vec<f64>>| values.as_ref().map(|values| values[row]);
        JointMessage {
            t_s: Some(time_s),
            position_count: self.count(row).filter(|_| self.position_rad.is_none()),
            position_rad: at(&self.position_rad),
            velocity_rad_per_s: at(&self.velocity_rad_per_s),
            command_v: self.joint.command_v[row],
            reference_rad: at(&self.joint.reference_rad),
            error_rad: at(&self.error_rad),
        }
    }

    /// The message of the channel of counts.
    pub(super) fn count_message(&self, row: usize, time_s: f64) -> Option<CountMessage> {
        let position_count = self.count(row).filter(|_| self.has_count_channel())?;
        Some(CountMessage { t_s: time_s, position_count })
    }

    fn count(&self, row: usize) -> Option<i64> {
        match &self.joint.position {
            Position::Count(counts) => Some(counts[row]),
            Position::Radian(_) => None,
        }
    }
}

fn rounded(value: f64, step: f64) -> f64 {
    let per_unit = (1.0 / step).round();
    let rounded = (value * per_unit).round() / per_unit;
    if rounded.is_finite() { rounded } else { value }
}

/// The reference less the position, whole turns left away.
fn error(error_rad: f64) -> f64 {
    rounded(error_rad - (error_rad / TAU).round() * TAU, ANGLE_STEP_RAD)
}

/// By central differences, at the ends by those to the neighbour.
fn velocity(time_s: &[f64], q_rad: &[f64]) -> Vec<f64> {
    let last = time_s.len() - 1;
    let at = |row: usize| {
        let (before, after) = (row.saturating_sub(1), (row + 1).min(last));
        match time_s[after] - time_s[before] {
            step_s if step_s > 0.0 => (q_rad[after] - q_rad[before]) / step_s,
            _ => 0.0,
        }
    };
    (0..time_s.len()).map(|row| rounded(at(row), VELOCITY_STEP_RAD_PER_S)).collect()
}
