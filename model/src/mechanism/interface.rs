//! The interface of all mechanisms.

use super::joint_kind::JointKind;
use super::parameter_name::ParameterName;
use crate::Real;

/// A mechanism of n joints: D(q) qdd + c(q, qd) + h(q) = tau, linear in p parameters.
///
/// The dimension is known at run time: slices go in and out, matrices row by row. Every slice
/// of a quantity per joint has n entries, in rad or m, Nm or N by [`Mechanism::kind`]. Torques
/// are those of the motors at the joint, rotors included, friction left out.
///
/// Derivatives by state or parameter: compute in [`crate::Dual`] numbers.
///
/// # Panics
/// All methods where a slice is shorter than stated; what lies behind is left alone.
///
/// ```
/// use model::mechanism::{Mechanism, Rrr};
/// use model::reference_robot::reference_robot;
///
/// /// The torques [Nm] that hold any mechanism still.
/// fn holding(arm: &dyn Mechanism<f64>, q: &[f64]) -> Vec<f64> {
///     let mut torque = vec![0.0; arm.joints()];
///     arm.gravity(q, &mut torque);
///     torque
/// }
///
/// let arm = Rrr::of(&reference_robot());
/// assert!((holding(&arm, &[0.0; 3])[1] - 18.25).abs() < 0.01);
/// ```
pub trait Mechanism<T: Real> {
    /// How many joints there are, n.
    fn joints(&self) -> usize;

    /// What the joint (0 to n - 1, from the base) does.
    fn kind(&self, joint: usize) -> JointKind;

    /// How many parameters the inverse dynamics is linear in, p.
    fn parameter_count(&self) -> usize;

    /// The name of a parameter, 0 to p - 1.
    fn parameter_name(&self, index: usize) -> ParameterName;

    /// The parameters' values, p of them.
    fn parameters(&self, values: &mut [T]);

    /// Other values of the parameters, p of them, taken as they are.
    fn set_parameters(&mut self, values: &[T]);

    /// Inverse dynamics: the torques that give the accelerations.
    fn inverse_dynamics(&self, q: &[T], qd: &[T], qdd: &[T], torque: &mut [T]);

    /// Forward dynamics: the accelerations that the torques give.
    fn forward_dynamics(&self, q: &[T], qd: &[T], torque: &[T], qdd: &mut [T]);

    /// Mass matrix D, n x n, symmetric, rotors included.
    fn mass_matrix(&self, q: &[T], mass: &mut [T]);

    /// Gravity torques h, n.
    fn gravity(&self, q: &[T], torque: &mut [T]);

    /// Regressor R, n x p: inverse dynamics = R times the parameters.
    fn regressor(&self, q: &[T], qd: &[T], qdd: &[T], rows: &mut [T]);

    /// Jacobian of the tip, 6 x n, in the base frame: three rows of its velocity by joint
    /// velocity, then three of its angular velocity.
    fn tip_jacobian(&self, q: &[T], rows: &mut [T]);
}
