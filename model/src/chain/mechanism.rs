//! A chain behind the interface of all mechanisms.

use super::body::{BODY_PARAMETERS, Body};
use super::regressor::{LINK_PARAMETERS, link_parameter_name};
use super::serial_chain::{MAX_JOINTS, SerialChain};
use crate::Real;
use crate::mechanism::{JointKind, Mechanism, ParameterName};

impl<T: Real> Mechanism<T> for SerialChain<T> {
    fn joints(&self) -> usize {
        self.placed().len()
    }

    fn kind(&self, joint: usize) -> JointKind {
        self.placed()[joint].joint.kind
    }

    fn parameter_count(&self) -> usize {
        LINK_PARAMETERS * self.placed().len()
    }

    fn parameter_name(&self, index: usize) -> ParameterName {
        let joint = index / LINK_PARAMETERS;
        let quantity = link_parameter_name(self.kind(joint), index % LINK_PARAMETERS);
        ParameterName { quantity, link: joint as u8 + 1 }
    }

    fn parameters(&self, values: &mut [T]) {
        for (placed, values) in self.placed().iter().zip(values.chunks_exact_mut(LINK_PARAMETERS)) {
            values[..BODY_PARAMETERS].copy_from_slice(&placed.joint.body.to_array());
            values[BODY_PARAMETERS] = placed.joint.armature;
        }
    }

    fn set_parameters(&mut self, values: &[T]) {
        for index in 0..self.placed().len() {
            let values = &values[LINK_PARAMETERS * index..][..LINK_PARAMETERS];
            let (body, armature) = self.link_mut(index);
            *body = Body::from_array(core::array::from_fn(|k| values[k]));
            *armature = values[BODY_PARAMETERS];
        }
    }

    #[inline]
    fn inverse_dynamics(&self, q: &[T], qd: &[T], qdd: &[T], torque: &mut [T]) {
        self.newton_euler(q, qd, qdd, torque);
    }

    fn forward_dynamics(&self, q: &[T], qd: &[T], torque: &[T], qdd: &mut [T]) {
        self.articulated_bodies(q, qd, torque, qdd);
    }

    fn mass_matrix(&self, q: &[T], mass: &mut [T]) {
        self.composite_bodies(q, mass);
    }

    fn gravity(&self, q: &[T], torque: &mut [T]) {
        let rest = [T::zero(); MAX_JOINTS];
        self.newton_euler(q, &rest, &rest, torque);
    }

    fn regressor(&self, q: &[T], qd: &[T], qdd: &[T], rows: &mut [T]) {
        self.rows(q, qd, qdd, rows);
    }

    fn tip_jacobian(&self, q: &[T], rows: &mut [T]) {
        self.jacobian(q, rows);
    }
}
