//! Coriolis and gravity torques along a stretch, which friction may follow.

use super::kinematics::{Joints, Middles};
use rig::plant::Body;

/// What a body's motion asks of its joints in the middle of every interval, accelerations apart: c + h of
/// eq. (5) [Nm; N].
pub fn loads(body: &Body, middles: &Middles) -> Vec<Joints> {
    let at = |k: usize| {
        let ((q_rad, qd_rad_per_s), mut load_nm) = (middles.at(k), Joints::default());
        body.load(q_rad, qd_rad_per_s, &mut load_nm);
        load_nm
    };
    (0..middles.len()).map(at).collect()
}
