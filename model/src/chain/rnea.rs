//! Inverse dynamics: the recursive Newton-Euler algorithm, RBDA Table 5.1.

use super::serial_chain::{MAX_JOINTS, SerialChain};
use super::spatial::{Force, Motion, Transform};
use crate::Real;

impl<T: Real> SerialChain<T> {
    /// tau_i = S_i . f_i + armature qdd_i, f_i = I_i a_i + v_i x* I_i v_i + f_{i+1},
    /// n torques from n positions, velocities and accelerations.
    #[inline]
    pub(super) fn newton_euler(&self, q: &[T], qd: &[T], qdd: &[T], torque: &mut [T]) {
        self.newton_euler_with(|joint| q[joint].sin_cos(), q, qd, qdd, torque);
    }

    /// Torques of n joints from n positions with their sines and cosines, velocities and accelerations
    /// [Nm; N]: inverse dynamics along a motion whose sines many bodies share.
    #[inline]
    pub fn inverse_dynamics_with_sines(
        &self,
        sines_cosines: &[(T, T)],
        q: &[T],
        qd: &[T],
        qdd: &[T],
        torque: &mut [T],
    ) {
        self.newton_euler_with(|joint| sines_cosines[joint], q, qd, qdd, torque);
    }

    #[inline]
    fn newton_euler_with(
        &self,
        sine_cosine: impl Fn(usize) -> (T, T),
        q: &[T],
        qd: &[T],
        qdd: &[T],
        torque: &mut [T],
    ) {
        let mut links = [(Transform::nowhere(), Force::zero()); MAX_JOINTS];
        let (mut velocity, mut acceleration) = (Motion::zero(), self.base_acceleration());
        for (index, (placed, link)) in self.placed().iter().zip(&mut links).enumerate() {
            let place = placed.place_with(q[index], || sine_cosine(index));
            velocity = placed.velocity(&place.motion_into(&velocity), qd[index]);
            let carried = place.motion_into(&acceleration);
            acceleration = placed.acceleration(&carried, &velocity, [qd[index], qdd[index]]);
            *link = (place, placed.joint.body.force(&velocity, &acceleration));
        }
        let mut beyond = Force::zero();
        for (index, (placed, link)) in self.placed().iter().zip(&links).enumerate().rev() {
            let force = link.1.plus(&beyond);
            torque[index] = placed.along(&force) + placed.joint.armature * qdd[index];
            beyond = link.0.force_out_of(&force);
        }
    }
}
