//! What of springs between motors and links another trial has computed already.

use std::sync::Arc;

use super::coupling::Coupling;
use crate::logs::joint_dynamics::JointDynamics;

/// The motors' side of springs, by joint: how motors move and what drives them. It is measured,
/// and thus the same for all hypotheses that differ in a spring alone: a search that varies a
/// spring computes it once.
pub trait MotorSide: Sync {
    /// Dynamics of a joint as if it were stiff, by samples; computed by `make` at first.
    fn dynamics(
        &self,
        joint: usize,
        make: &dyn Fn() -> Arc<Vec<JointDynamics>>,
    ) -> &Arc<Vec<JointDynamics>>;

    /// What a joint's link ahead of its motor pulls at all joints; computed by `make` at first.
    fn coupling(&self, joint: usize, make: &dyn Fn() -> Coupling) -> &Coupling;

    /// What drives a joint less friction, by intervals [V].
    fn net_v(&self, joint: usize) -> &[f64];
}
