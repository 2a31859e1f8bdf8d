//! Spatial vectors and coordinate transforms (RBDA 2.2 to 2.9), angular part first.

use crate::Real;
use crate::vector::{
    Matrix3, Vector3, add, cross, dot, multiply, multiply_transposed, product, scale,
};

/// Velocity or acceleration of a rigid body, in the coordinates of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<T> {
    /// Angular velocity [rad/s].
    pub angular: Vector3<T>,
    /// Velocity of the point of the body that is at the frame's origin [m/s].
    pub linear: Vector3<T>,
}

/// Force on a rigid body, or its momentum, in the coordinates of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Force<T> {
    /// Moment about the frame's origin [Nm].
    pub moment: Vector3<T>,
    /// Force [N].
    pub force: Vector3<T>,
}

/// Where a frame stands in its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform<T> {
    /// Turns coordinates of the frame into those of the parent; E of RBDA transposed.
    pub rotation: Matrix3<T>,
    /// The frame's origin in the parent [m].
    pub position: Vector3<T>,
}

impl<T: Real> Motion<T> {
    /// Rest.
    #[inline]
    pub fn zero() -> Self {
        Self { angular: [T::zero(); 3], linear: [T::zero(); 3] }
    }

    /// Sum.
    #[inline]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            angular: add(&self.angular, &other.angular),
            linear: add(&self.linear, &other.linear),
        }
    }

    /// The vector times a number.
    #[inline]
    pub fn times(&self, factor: T) -> Self {
        Self { angular: scale(&self.angular, factor), linear: scale(&self.linear, factor) }
    }

    /// v x m, eq. (2.31): the change of `other` that moves with this velocity.
    #[inline]
    pub fn cross(&self, other: &Self) -> Self {
        Self {
            angular: cross(&self.angular, &other.angular),
            linear: add(&cross(&self.angular, &other.linear), &cross(&self.linear, &other.angular)),
        }
    }

    /// v x* f, eq. (2.32).
    #[inline]
    pub fn cross_force(&self, force: &Force<T>) -> Force<T> {
        Force {
            moment: add(&cross(&self.angular, &force.moment), &cross(&self.linear, &force.force)),
            force: cross(&self.angular, &force.force),
        }
    }

    /// Scalar product with a force: power [W].
    #[inline]
    pub fn dot(&self, force: &Force<T>) -> T {
        dot(&self.angular, &force.moment) + dot(&self.linear, &force.force)
    }
}

impl<T: Real> Force<T> {
    /// No force.
    #[inline]
    pub fn zero() -> Self {
        Self { moment: [T::zero(); 3], force: [T::zero(); 3] }
    }

    /// Sum.
    #[inline]
    pub fn plus(&self, other: &Self) -> Self {
        Self { moment: add(&self.moment, &other.moment), force: add(&self.force, &other.force) }
    }

    /// The vector times a number.
    #[inline]
    pub fn times(&self, factor: T) -> Self {
        Self { moment: scale(&self.moment, factor), force: scale(&self.force, factor) }
    }
}

impl<T: Real> Transform<T> {
    /// The frame that is its parent.
    pub fn identity() -> Self {
        let (zero, one) = (T::zero(), T::one());
        let rotation = [[one, zero, zero], [zero, one, zero], [zero, zero, one]];
        Self { rotation, position: [zero; 3] }
    }

    /// All zero, no frame: room for one.
    #[inline]
    pub(super) fn nowhere() -> Self {
        Self { rotation: [[T::zero(); 3]; 3], position: [T::zero(); 3] }
    }

    /// A motion from the parent's coordinates into the frame's: X m, eq. (2.24).
    #[inline]
    pub fn motion_into(&self, motion: &Motion<T>) -> Motion<T> {
        let shifted = add(&motion.linear, &cross(&motion.angular, &self.position));
        Motion {
            angular: multiply_transposed(&self.rotation, &motion.angular),
            linear: multiply_transposed(&self.rotation, &shifted),
        }
    }

    /// A force from the frame's coordinates into the parent's: X^T f, eq. (2.25).
    #[inline]
    pub fn force_out_of(&self, force: &Force<T>) -> Force<T> {
        let turned = multiply(&self.rotation, &force.force);
        let moment = multiply(&self.rotation, &force.moment);
        Force { moment: add(&moment, &cross(&self.position, &turned)), force: turned }
    }

    /// A point from the frame's coordinates into the parent's [m].
    #[inline]
    pub fn point_out_of(&self, point: &Vector3<T>) -> Vector3<T> {
        add(&self.position, &multiply(&self.rotation, point))
    }

    /// The frame `inner`, which stands in this frame, as it stands in the parent.
    pub fn then(&self, inner: &Self) -> Self {
        Self {
            rotation: product(&self.rotation, &inner.rotation),
            position: self.point_out_of(&inner.position),
        }
    }
}
