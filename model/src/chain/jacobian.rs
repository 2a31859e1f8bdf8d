//! Pose and Jacobian of the tip.

use super::serial_chain::SerialChain;
use super::spatial::Transform;
use crate::Real;
use crate::mechanism::JointKind;
use crate::vector::{cross, multiply, subtract};

impl<T: Real> SerialChain<T> {
    /// Where the last link's frame, moved to the tip, stands in the base.
    #[inline]
    pub fn tip(&self, q: &[T]) -> Transform<T> {
        let chain = self.placed().iter().zip(q);
        let last = chain.fold(Transform::identity(), |all, (joint, q)| all.then(&joint.place(*q)));
        Transform { position: last.point_out_of(&self.tip_m()), ..last }
    }

    /// 6 x n, velocity over angular velocity in the base frame: axis x (tip - joint) and axis of
    /// a revolute joint, axis and 0 of a prismatic one.
    #[inline]
    pub(super) fn jacobian(&self, q: &[T], rows: &mut [T]) {
        let (tip, n) = (self.tip(q).position, self.placed().len());
        let mut frame = Transform::identity();
        for (column, placed) in self.placed().iter().enumerate() {
            frame = frame.then(&placed.place(q[column]));
            let axis = multiply(&frame.rotation, &placed.joint.axis);
            let (velocity, turning) = match placed.joint.kind {
                JointKind::Revolute => (cross(&axis, &subtract(&tip, &frame.position)), axis),
                JointKind::Prismatic => (axis, [T::zero(); 3]),
            };
            for row in 0..3 {
                rows[row * n + column] = velocity[row];
                rows[(row + 3) * n + column] = turning[row];
            }
        }
    }
}
