//! Inverse dynamics: the recursive Newton-Euler algorithm, RBDA Table 5.1.

use super::serial_chain::SerialChain;
use super::spatial::Force;
use crate::Real;

impl<T: Real> SerialChain<T> {
    /// tau_i = S_i . f_i + armature qdd_i, f_i = I_i a_i + v_i x* I_i v_i + f_{i+1},
    /// n torques from n positions, velocities and accelerations.
    #[inline]
    pub(super) fn newton_euler(&self, q: &[T], qd: &[T], qdd: &[T], torque: &mut [T]) {
        let links = self.link_motions(q, qd, qdd);
        let mut beyond = Force::zero();
        for (index, placed) in self.placed().iter().enumerate().rev() {
            let (link, joint) = (&links[index], &placed.joint);
            let force = joint.body.force(&link.velocity, &link.acceleration).plus(&beyond);
            torque[index] = placed.subspace.dot(&force) + joint.armature * qdd[index];
            beyond = link.place.force_out_of(&force);
        }
    }
}
