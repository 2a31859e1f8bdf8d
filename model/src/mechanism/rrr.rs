//! The robot of MODEL.md, in closed form, as a mechanism.

use super::interface::Mechanism;
use super::joint_kind::JointKind;
use super::parameter_name::ParameterName;
use crate::base::{COUNT, NAMES};
use crate::vector::{Vector3, cross, subtract};
use crate::{BaseParameters, Geometry, Posture, Real, Robot, regressor::regressor};

/// The rigid body of the three-joint robot; its parameters are the 16 of [`NAMES`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rrr<T> {
    /// Lengths and gravity.
    pub geometry: Geometry<T>,
    /// Base parameters.
    pub base: BaseParameters<T>,
}

impl<T: Real> Rrr<T> {
    /// The rigid body of a robot.
    pub fn of(robot: &Robot<T>) -> Self {
        Self { geometry: robot.geometry, base: robot.base }
    }
}

fn posture<T: Real>(q: &[T]) -> Posture<T> {
    Posture::new(q[1], q[2])
}

fn three<T: Real>(values: &[T]) -> Vector3<T> {
    [values[0], values[1], values[2]]
}

impl<T: Real> Mechanism<T> for Rrr<T> {
    fn joints(&self) -> usize {
        3
    }

    fn kind(&self, _joint: usize) -> JointKind {
        JointKind::Revolute
    }

    fn parameter_count(&self) -> usize {
        COUNT
    }

    fn parameter_name(&self, index: usize) -> ParameterName {
        ParameterName { quantity: NAMES[index], link: 0 }
    }

    fn parameters(&self, values: &mut [T]) {
        values[..COUNT].copy_from_slice(&self.base.to_array());
    }

    fn set_parameters(&mut self, values: &[T]) {
        self.base = BaseParameters::from_array(core::array::from_fn(|index| values[index]));
    }

    #[inline]
    fn inverse_dynamics(&self, q: &[T], qd: &[T], qdd: &[T], torque: &mut [T]) {
        let (qd, qdd) = (three(qd), three(qdd));
        let found = posture(q).inverse_dynamics(&self.base, &self.geometry, &qd, &qdd);
        torque[..3].copy_from_slice(&found);
    }

    #[inline]
    fn forward_dynamics(&self, q: &[T], qd: &[T], torque: &[T], qdd: &mut [T]) {
        let (qd, torque) = (three(qd), three(torque));
        let found = posture(q).forward_dynamics(&self.base, &self.geometry, &qd, &torque);
        qdd[..3].copy_from_slice(&found);
    }

    fn mass_matrix(&self, q: &[T], mass: &mut [T]) {
        let found = posture(q).mass_matrix(&self.base, &self.geometry);
        mass[..9].copy_from_slice(found.as_flattened());
    }

    fn gravity(&self, q: &[T], torque: &mut [T]) {
        torque[..3].copy_from_slice(&posture(q).gravity(&self.base, &self.geometry));
    }

    #[inline]
    fn regressor(&self, q: &[T], qd: &[T], qdd: &[T], rows: &mut [T]) {
        let found = regressor(&posture(q), &self.geometry, &three(qd), &three(qdd));
        rows[..3 * COUNT].copy_from_slice(found.as_flattened());
    }

    /// The columns axis x (tip - joint) over axis, of the Denavit-Hartenberg frames of Table 1.
    fn tip_jacobian(&self, q: &[T], rows: &mut [T]) {
        let Geometry { d1_m, d2_m, a2_m, d3_m, a3_m, .. } = self.geometry;
        let Posture { s2, c2, s23, c23, .. } = posture(q);
        let (s1, c1) = q[0].sin_cos();
        let (zero, one) = (T::zero(), T::one());
        let side = [s1, -c1, zero];
        let reach = |along: T, up: T, across: T| -> Vector3<T> {
            [c1 * along + s1 * across, s1 * along - c1 * across, d1_m + up]
        };
        let tip = reach(a2_m * c2 + a3_m * c23, a2_m * s2 + a3_m * s23, d2_m + d3_m);
        let joints = [
            ([zero, zero, one], [zero; 3]),
            (side, [zero, zero, d1_m]),
            (side, reach(a2_m * c2, a2_m * s2, d2_m)),
        ];
        for (column, (axis, at)) in joints.into_iter().enumerate() {
            let velocity = cross(&axis, &subtract(&tip, &at));
            for row in 0..3 {
                rows[3 * row + column] = velocity[row];
                rows[9 + 3 * row + column] = axis[row];
            }
        }
    }
}
