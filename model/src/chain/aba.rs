//! Forward dynamics: the articulated body algorithm, RBDA Table 7.1.

use super::articulated_body::ArticulatedBody;
use super::body::Body;
use super::serial_chain::{MAX_JOINTS, SerialChain};
use super::spatial::{Force, Motion, Transform};
use crate::Real;

/// What a joint's pass from the tip to the base leaves for the pass back.
#[derive(Clone, Copy)]
struct Released<T> {
    place: Transform<T>,
    velocity: Motion<T>,
    /// c_i = v_i x S qd, eq. (7.31).
    drift: Motion<T>,
    /// U_i = I^A_i S_i, eq. (7.43).
    force: Force<T>,
    /// D_i = S_i . U_i + armature, eq. (7.44).
    inertia: T,
    /// u_i = tau_i - S_i . p^A_i, eq. (7.45).
    torque: T,
}

impl<T: Real> SerialChain<T> {
    /// The n accelerations that n torques give.
    #[inline]
    pub(super) fn articulated_bodies(&self, q: &[T], qd: &[T], torque: &[T], qdd: &mut [T]) {
        let mut links = self.moving_links(q, qd);
        self.release_joints(&mut links, torque);
        let mut acceleration = self.base_acceleration();
        for (index, placed) in self.placed().iter().enumerate() {
            let link = &links[index];
            acceleration = link.place.motion_into(&acceleration).plus(&link.drift);
            qdd[index] = (link.torque - acceleration.dot(&link.force)) / link.inertia;
            acceleration = acceleration.plus(&placed.subspace.times(qdd[index]));
        }
    }

    /// Velocities, base to tip.
    #[inline]
    fn moving_links(&self, q: &[T], qd: &[T]) -> [Released<T>; MAX_JOINTS] {
        let (mut velocity, zero) = (Motion::zero(), T::zero());
        let base = Released {
            place: Transform::nowhere(),
            velocity,
            drift: velocity,
            force: Force::zero(),
            inertia: zero,
            torque: zero,
        };
        let mut links = [base; MAX_JOINTS];
        for (index, placed) in self.placed().iter().enumerate() {
            let place = placed.place(q[index]);
            velocity = placed.velocity(&place.motion_into(&velocity), qd[index]);
            let drift = placed.acceleration(&Motion::zero(), &velocity, [qd[index], T::zero()]);
            links[index] = Released { place, velocity, drift, ..base };
        }
        links
    }

    /// Articulated inertias and bias forces, tip to base, eq. (7.41) to (7.47).
    #[inline]
    fn release_joints(&self, links: &mut [Released<T>; MAX_JOINTS], torque: &[T]) {
        let mut beyond = ArticulatedBody::of(&Body::zero());
        let mut bias_beyond = Force::zero();
        for (index, placed) in self.placed().iter().enumerate().rev() {
            let (link, joint) = (&mut links[index], &placed.joint);
            let body = ArticulatedBody::of(&joint.body).plus(&beyond);
            let momentum = joint.body.times(&link.velocity);
            let bias = link.velocity.cross_force(&momentum).plus(&bias_beyond);
            link.force = body.times(&placed.subspace);
            link.inertia = placed.along(&link.force) + joint.armature;
            link.torque = torque[index] - placed.along(&bias);
            let left = body.released(&link.force, link.inertia);
            let given = link.force.times(link.torque / link.inertia);
            let bias = bias.plus(&left.times(&link.drift)).plus(&given);
            beyond = left.out_of(&link.place);
            bias_beyond = link.place.force_out_of(&bias);
        }
    }
}
