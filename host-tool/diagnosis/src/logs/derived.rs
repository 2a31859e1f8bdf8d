//! What follows from the motion of a stretch, once it is asked for.

use std::sync::OnceLock;

use model::chain::MAX_JOINTS;

use super::joint_dynamics::JointDynamics;
use super::kinematics::{Joints, Middles, Sines};
use super::last::Last;
use crate::trial::payload::PayloadColumns;

/// What follows from a motion; whoever changes that begins anew.
#[derive(Clone, Debug, Default)]
pub struct Derived {
    /// Sines and cosines of all joints' angles, which a chain takes.
    pub sines: OnceLock<Vec<Sines>>,
    /// Angles and velocities in the middle of the intervals.
    pub middles: OnceLock<Middles>,
    /// Loads of the bodies that were tried last.
    pub loads: Last<Vec<Joints>>,
    /// Torques of the bodies that were tried last, joint by joint [Nm].
    pub torques: Last<Vec<Vec<f64>>>,
    /// Those of what a chain's last link may carry, by each of its ten numbers.
    pub payload: OnceLock<PayloadColumns>,
    /// Each joint's equation of motion with them.
    pub dynamics: [Last<Vec<JointDynamics>>; MAX_JOINTS],
}
