//! How well a recorded motion followed its reference.

use files::{JointLog, Log};
use signal::rms;

/// One joint's tracking.
#[derive(Clone, Debug, PartialEq)]
pub struct Tracking {
    /// Joint, 1 to 3.
    pub joint: u8,
    /// Reference less measured angle [rad], sample by sample.
    pub error_rad: Vec<f64>,
}

impl Tracking {
    /// Of every joint of a log that has a reference.
    pub fn of(log: &Log, counts_per_turn: f64) -> Vec<Self> {
        log.joints.iter().filter_map(|joint| Self::of_joint(joint, counts_per_turn)).collect()
    }

    fn of_joint(joint: &JointLog, counts_per_turn: f64) -> Option<Self> {
        let reference = joint.reference_rad.as_ref()?;
        let position = joint.position_rad(counts_per_turn);
        let error_rad = reference.iter().zip(&position).map(|(r, q)| r - q).collect();
        Some(Self { joint: joint.joint, error_rad })
    }

    /// Root mean square of the error [rad].
    pub fn rms_rad(&self) -> f64 {
        rms(&self.error_rad)
    }
}
