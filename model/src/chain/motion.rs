//! How all links move, from the base to the tip.

use super::serial_chain::{MAX_JOINTS, SerialChain};
use super::spatial::{Motion, Transform};
use crate::Real;

/// A link's motion in its own frame, gravity as an acceleration of the base.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinkMotion<T> {
    /// Where the link stands in the one before.
    pub(super) place: Transform<T>,
    /// v_i = X v_{i-1} + S qd, eq. (5.7).
    pub(super) velocity: Motion<T>,
    /// a_i = X a_{i-1} + S qdd + v_i x S qd, eq. (5.8).
    pub(super) acceleration: Motion<T>,
}

impl<T: Real> SerialChain<T> {
    /// The motion of the n links; the entries behind them mean nothing.
    #[inline]
    pub(super) fn link_motions(&self, q: &[T], qd: &[T], qdd: &[T]) -> [LinkMotion<T>; MAX_JOINTS] {
        let (mut velocity, mut acceleration) = (Motion::zero(), self.base_acceleration());
        let base = LinkMotion { place: Transform::nowhere(), velocity, acceleration };
        let mut links = [base; MAX_JOINTS];
        for (index, placed) in self.placed().iter().enumerate() {
            let place = placed.place(q[index]);
            velocity = placed.velocity(&place.motion_into(&velocity), qd[index]);
            let carried = place.motion_into(&acceleration);
            acceleration = placed.acceleration(&carried, &velocity, [qd[index], qdd[index]]);
            links[index] = LinkMotion { place, velocity, acceleration };
        }
        links
    }

    /// Where each of the n links stands in the one before; the entries behind mean nothing.
    #[inline]
    pub(super) fn places(&self, q: &[T]) -> [Transform<T>; MAX_JOINTS] {
        let mut places = [Transform::nowhere(); MAX_JOINTS];
        for (index, placed) in self.placed().iter().enumerate() {
            places[index] = placed.place(q[index]);
        }
        places
    }
}
