//! The residual of each joint's command.

use nalgebra::DVector;
use serde::Serialize;
use signal::rms;

use super::rows::Rows;
use super::solve::Stack;

/// The residual of a joint's command.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct JointResidual {
    /// Joint, 1 to 3.
    pub joint: u8,
    /// Root mean square of the residual [V].
    pub rms_v: f64,
    /// Root mean square of the command itself [V].
    pub command_rms_v: f64,
    /// Residual over command.
    pub share: f64,
}

impl JointResidual {
    /// Of a joint, from root mean squares [V].
    pub fn new(joint: u8, rms_v: f64, command_rms_v: f64) -> Self {
        Self { joint, rms_v, command_rms_v, share: rms_v / command_rms_v }
    }
}

/// The residuals of all joints.
pub(in super::super) fn joint_residuals(
    stack: &Stack,
    stretches: &[Rows],
    residuals: &DVector<f64>,
) -> Vec<JointResidual> {
    let commands =
        stack.origin.iter().map(|at| stretches[at.stretch].joints[at.joint].command_v[at.instant]);
    let commands = DVector::from_iterator(stack.origin.len(), commands);
    let by_joint = stack.by_joint(residuals);
    (1..)
        .zip(by_joint.iter().zip(&stack.by_joint(&commands)))
        .map(|(joint, (left, command))| JointResidual::new(joint, rms(left), rms(command)))
        .collect()
}
