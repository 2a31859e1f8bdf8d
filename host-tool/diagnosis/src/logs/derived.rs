//! What follows from the motion of a stretch, once it is asked for.

use std::sync::{Arc, OnceLock};

use model::chain::{BODY_PARAMETERS, MAX_JOINTS};

use super::joint_dynamics::JointDynamics;
use super::kinematics::{Joints, Middles, Sines, Sliding};
use super::last::Last;

/// The ten numbers of what a chain's last link carries beyond the model's own: m, m c (3), inertia about its origin (6).
pub type Payload = [f64; BODY_PARAMETERS];

/// Torques of each joint at the samples per unit of each of the ten numbers of a body on the last link [Nm].
pub type PayloadColumns = Vec<Vec<[f64; BODY_PARAMETERS]>>;

/// What follows from a motion; whoever changes that begins anew.
#[derive(Clone, Debug, Default)]
pub struct Derived {
    /// Sines and cosines of all joints' angles, which a chain takes.
    pub sines: OnceLock<Vec<Sines>>,
    /// Angles and velocities in the middle of the intervals.
    pub middles: OnceLock<Middles>,
    /// What each joint's friction follows.
    pub sliding: [OnceLock<Sliding>; MAX_JOINTS],
    /// Loads of the bodies that were tried last.
    pub loads: Last<Vec<Joints>>,
    /// Each joint's equation of motion with them.
    pub dynamics: [Last<Vec<JointDynamics>>; MAX_JOINTS],
    /// Torques of the bodies that were tried last, joint by joint [Nm].
    pub torques: Last<Vec<Vec<f64>>>,
    /// Those of what a chain's last link may carry: its geometry and gravity are the same in all that is tried.
    pub payload: OnceLock<Arc<PayloadColumns>>,
}
