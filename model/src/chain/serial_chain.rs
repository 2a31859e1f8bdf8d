//! A chain of links, base to tip.

use super::body::Body;
use super::joint::{Joint, PlacedJoint};
use super::spatial::{Motion, Transform};
use crate::Real;
use crate::parameter::{ParameterError, named};
use crate::vector::{Vector3, scale};

/// The most joints of a chain: a gantry of two, an arm of seven and a gripper.
pub const MAX_JOINTS: usize = 10;

/// A serial chain of revolute and prismatic joints.
///
/// ```
/// use model::chain::{Body, Joint, SerialChain, Transform};
/// use model::mechanism::{JointKind, Mechanism};
///
/// // A pendulum: 2 kg, half a metre from a horizontal axis; level at q = 0.
/// let pendulum = Joint {
///     kind: JointKind::Revolute,
///     origin: Transform::identity(),
///     axis: [0.0, -1.0, 0.0],
///     body: Body::point(2.0, [0.5, 0.0, 0.0]),
///     armature: 0.1,
/// };
/// let chain = SerialChain::new([0.0, 0.0, -9.81], &[pendulum])?;
/// let mut torque_nm = [0.0_f64];
/// chain.inverse_dynamics(&[0.0], &[0.0], &[1.0], &mut torque_nm);
/// assert!((torque_nm[0] - (9.81 + 0.5 + 0.1)).abs() < 1e-12);
/// # Ok::<(), model::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SerialChain<T> {
    gravity_m_s2: Vector3<T>,
    tip_m: Vector3<T>,
    count: usize,
    joints: [PlacedJoint<T>; MAX_JOINTS],
}

impl<T: Real> SerialChain<T> {
    /// A chain of 1 to [`MAX_JOINTS`] joints, base to tip; gravity in the base frame [m/s^2].
    ///
    /// Bodies may be anything, so that parameters can be varied: forward dynamics needs those of
    /// which D is positive definite.
    ///
    /// # Errors
    /// Too few or many joints, an axis without length, a place that is no finite number.
    pub fn new(gravity_m_s2: Vector3<T>, joints: &[Joint<T>]) -> Result<Self, ParameterError> {
        named("number of joints", T::constant(joints.len() as f64))
            .require((1..=MAX_JOINTS).contains(&joints.len()), "be 1 to 10")?;
        for component in gravity_m_s2 {
            named("gravity_m_s2", component).finite()?;
        }
        let placed = |index: usize| PlacedJoint::of(joints[index], index as u8 + 1);
        let mut all = [placed(0)?; MAX_JOINTS];
        for index in 0..joints.len() {
            all[index] = placed(index)?;
        }
        let chain = Self { gravity_m_s2, tip_m: [T::zero(); 3], count: joints.len(), joints: all };
        chain.check()
    }

    fn check(self) -> Result<Self, ParameterError> {
        for (number, placed) in (1..).zip(self.placed()) {
            let Transform { rotation, position } = placed.joint.origin;
            for entry in rotation.into_iter().flatten() {
                named("origin_rpy_rad", entry).of_joint(number).finite()?;
            }
            for entry in position {
                named("origin_xyz_m", entry).of_joint(number).finite()?;
            }
        }
        Ok(self)
    }

    /// The same chain with its tip at another point of the last link [m]; else it is the origin
    /// of the last link's frame.
    pub fn with_tip(self, tip_m: Vector3<T>) -> Self {
        Self { tip_m, ..self }
    }

    /// The same chain with a body added to its last link, in that link's frame; a negative one
    /// where the chain carries too much.
    pub fn with_payload(mut self, payload: &Body<T>) -> Self {
        let last = &mut self.joints[self.count - 1].joint;
        last.body = last.body.plus(payload);
        self
    }

    /// The same chain under another gravity, in the base frame [m/s^2].
    pub fn with_gravity(self, gravity_m_s2: Vector3<T>) -> Self {
        Self { gravity_m_s2, ..self }
    }

    /// The joints, base to tip, axes made one long.
    pub fn joints(&self) -> impl Iterator<Item = &Joint<T>> {
        self.placed().iter().map(|placed| &placed.joint)
    }

    /// The link of a joint (from 0) and the joint's rotor, to be changed.
    pub fn link_mut(&mut self, joint: usize) -> (&mut Body<T>, &mut T) {
        let joint = &mut self.joints[..self.count][joint].joint;
        (&mut joint.body, &mut joint.armature)
    }

    /// Gravity in the base frame [m/s^2].
    pub fn gravity_m_s2(&self) -> Vector3<T> {
        self.gravity_m_s2
    }

    /// The tip in the frame of the last link [m].
    pub fn tip_m(&self) -> Vector3<T> {
        self.tip_m
    }

    /// The same chain in another number type.
    pub fn cast<U: Real>(&self) -> SerialChain<U> {
        let number = |x: T| U::constant(x.as_f64());
        let joints = self.joints.map(|placed| placed.cast());
        SerialChain {
            gravity_m_s2: self.gravity_m_s2.map(number),
            tip_m: self.tip_m.map(number),
            count: self.count,
            joints,
        }
    }

    /// The joints with what is known of them before q.
    #[inline]
    pub(super) fn placed(&self) -> &[PlacedJoint<T>] {
        &self.joints[..self.count]
    }

    /// What an acceleration of the base would be that feels like gravity, RBDA 5.3.
    #[inline]
    pub(super) fn base_acceleration(&self) -> Motion<T> {
        Motion { angular: [T::zero(); 3], linear: scale(&self.gravity_m_s2, -T::one()) }
    }
}
