//! A joint of a chain, with the link that it moves.

use super::body::Body;
use super::spatial::{Force, Motion, Transform};
use crate::Real;
use crate::mechanism::JointKind;
use crate::parameter::{ParameterError, named};
use crate::vector::{
    Matrix3, Vector3, add, add_scaled, cross, dot, multiply, product, scale, skew,
};

/// A joint and its link, as URDF describes them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint<T> {
    /// What the joint does.
    pub kind: JointKind,
    /// Where the joint's frame stands at q = 0 in the frame of the link before.
    pub origin: Transform<T>,
    /// The axis in the joint's frame; its length does not count.
    pub axis: Vector3<T>,
    /// The link that this joint moves, in the joint's frame.
    pub body: Body<T>,
    /// The rotor's inertia as seen at the joint [kg m^2; kg].
    pub armature: T,
}

/// The rotation of roll, pitch and yaw [rad], as in URDF: Rz(yaw) Ry(pitch) Rx(roll).
pub fn rotation_of_rpy<T: Real>(rpy_rad: Vector3<T>) -> Matrix3<T> {
    let [(sr, cr), (sp, cp), (sy, cy)] = rpy_rad.map(Real::sin_cos);
    [
        [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
        [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
        [-sp, cp * sr, cp * cr],
    ]
}

/// A joint, and of its axis' rotation all that does not depend on q.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlacedJoint<T> {
    pub(super) joint: Joint<T>,
    /// The axis as a motion: S of RBDA 4.4, (axis, 0) or (0, axis).
    pub(super) subspace: Motion<T>,
    /// Origin's rotation times skew(axis), and times its square.
    turned: [Matrix3<T>; 2],
    /// The axis in the frame of the link before.
    slide: Vector3<T>,
}

impl<T: Real> PlacedJoint<T> {
    /// The joint, its axis made one long; `number` from 1.
    pub(super) fn of(joint: Joint<T>, number: u8) -> Result<Self, ParameterError> {
        let length = dot(&joint.axis, &joint.axis).sqrt();
        named("axis", length).of_joint(number).positive()?;
        let axis = scale(&joint.axis, T::one() / length);
        let (turn, zero) = (skew(&axis), [T::zero(); 3]);
        let once = product(&joint.origin.rotation, &turn);
        let subspace = match joint.kind {
            JointKind::Revolute => Motion { angular: axis, linear: zero },
            JointKind::Prismatic => Motion { angular: zero, linear: axis },
        };
        Ok(Self {
            joint: Joint { axis, ..joint },
            subspace,
            turned: [once, product(&once, &turn)],
            slide: multiply(&joint.origin.rotation, &axis),
        })
    }

    /// Where the link stands in the link before at `q` [rad; m]: by Rodrigues' formula
    /// R = R0 (1 + sin q skew(a) + (1 - cos q) skew(a)^2), or slid along the axis.
    #[inline]
    pub(super) fn place(&self, q: T) -> Transform<T> {
        self.place_with(q, || q.sin_cos())
    }

    /// The same with sine and cosine of `q`, asked for where the joint turns.
    #[inline]
    pub(super) fn place_with(&self, q: T, sine_cosine: impl FnOnce() -> (T, T)) -> Transform<T> {
        let origin = &self.joint.origin;
        match self.joint.kind {
            JointKind::Revolute => {
                let (sine, cosine) = sine_cosine();
                let half = add_scaled(&origin.rotation, &self.turned[0], sine);
                let rotation = add_scaled(&half, &self.turned[1], T::one() - cosine);
                Transform { rotation, position: origin.position }
            }
            JointKind::Prismatic => {
                let position = add(&origin.position, &scale(&self.slide, q));
                Transform { rotation: origin.rotation, position }
            }
        }
    }

    /// The same joint in another number type.
    pub(super) fn cast<U: Real>(&self) -> PlacedJoint<U> {
        let number = |x: T| U::constant(x.as_f64());
        let vector = |v: Vector3<T>| v.map(number);
        let matrix = |m: Matrix3<T>| m.map(vector);
        let Joint { kind, origin, axis, body, armature } = self.joint;
        let origin =
            Transform { rotation: matrix(origin.rotation), position: vector(origin.position) };
        let (body, armature) = (body.cast(), number(armature));
        let Motion { angular, linear } = self.subspace;
        PlacedJoint {
            joint: Joint { kind, origin, axis: vector(axis), body, armature },
            subspace: Motion { angular: vector(angular), linear: vector(linear) },
            turned: self.turned.map(matrix),
            slide: vector(self.slide),
        }
    }

    /// v + S qd, eq. (5.7).
    #[inline]
    pub(super) fn velocity(&self, carried: &Motion<T>, qd: T) -> Motion<T> {
        let own = scale(&self.joint.axis, qd);
        match self.joint.kind {
            JointKind::Revolute => Motion { angular: add(&carried.angular, &own), ..*carried },
            JointKind::Prismatic => Motion { linear: add(&carried.linear, &own), ..*carried },
        }
    }

    /// a + S qdd + v x S qd, eq. (5.8), `velocity` with the joint's own.
    #[inline]
    pub(super) fn acceleration(
        &self,
        carried: &Motion<T>,
        velocity: &Motion<T>,
        [qd, qdd]: [T; 2],
    ) -> Motion<T> {
        let own = scale(&self.joint.axis, qd);
        let turned = add(&scale(&self.joint.axis, qdd), &cross(&velocity.angular, &own));
        let Motion { angular, linear } = carried;
        match self.joint.kind {
            JointKind::Revolute => Motion {
                angular: add(angular, &turned),
                linear: add(linear, &cross(&velocity.linear, &own)),
            },
            JointKind::Prismatic => Motion { angular: *angular, linear: add(linear, &turned) },
        }
    }

    /// S . f: the force along the axis, or the moment about it.
    #[inline]
    pub(super) fn along(&self, force: &Force<T>) -> T {
        match self.joint.kind {
            JointKind::Revolute => dot(&self.joint.axis, &force.moment),
            JointKind::Prismatic => dot(&self.joint.axis, &force.force),
        }
    }
}
