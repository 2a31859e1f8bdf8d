//! Logs of arms of any kind: every quantity in the units of its joint and drive.

mod columns;
mod read;
mod write;

/// A recorded log of an arm; row `i` of a joint belongs to `time_s[i]`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ArmLog {
    /// Sample times [s], strictly increasing, not always evenly spaced.
    pub time_s: Vec<f64>,
    /// The arm's joints, base to tip.
    pub joints: Vec<ArmJointLog>,
}

/// What a log says of one joint.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ArmJointLog {
    /// Measured position of the joint [rad; m], whichever shaft the encoder is on.
    pub position: Vec<f64>,
    /// The command [V; A; Nm; N], or the goal of a position servo [rad; m].
    pub command: Vec<f64>,
    /// Reference position of a joint that is no position servo [rad; m].
    pub reference: Option<Vec<f64>>,
    /// Velocity that the drive reports [rad/s; m/s].
    pub velocity: Option<Vec<f64>>,
    /// Torque that the drive reports [Nm; N].
    pub torque: Option<Vec<f64>>,
}

impl ArmLog {
    /// How many samples each joint has.
    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    /// Whether there is no sample.
    pub fn is_empty(&self) -> bool {
        self.time_s.is_empty()
    }
}

/// The columns of a joint in a log, its number from 1: position, command (of a position servo its
/// goal) and reference.
pub fn columns(number: usize, joint: &crate::ArmJoint) -> [String; 3] {
    let all = columns::Columns::of(number, joint);
    [all.position, all.command, all.reference]
}
