//! Effects that the rigid-body model, eq. (1), and the LuGre friction, eq. (9), lack.
//!
//! Each effect is defined here once, for the simulated robot that has it and for the
//! controller that compensates it. u is the command, w the voltage that the motor
//! gets, q the joint, n a harmonic per turn.
//!
//! | function | effect |
//! | --- | --- |
//! | [`torque_constant_factor`], [`ripple_factor`], [`dead_zone`] | w from u, the first two as factors |
//! | [`dead_zone_inverse`] | u from w |
//! | [`cogging_v`], [`cable_spring_v`], [`quadratic_drag_v`] | added to w, whatever u is |
//! | [`table_v`] | a curve added to w, by its knots |
//! | [`scale_position_friction`], [`scale_asymmetric_friction`] | change the friction of eq. (9) |
//! | [`Tilt`], [`Posture::tip_force_torque`] | torques of external loads |
//! | [`with_payload`] | base parameters with a mass at the tip |
//!
//! [`Posture::tip_force_torque`]: crate::Posture::tip_force_torque

mod command;
mod external_load;
mod friction;
mod payload;
mod table;
mod voltage;

pub use command::{dead_zone, dead_zone_inverse, ripple_factor, torque_constant_factor};
pub use external_load::Tilt;
pub use friction::{scale_asymmetric_friction, scale_position_friction};
pub use payload::with_payload;
pub use table::table_v;
pub use voltage::{cable_spring_v, cogging_v, quadratic_drag_v};

use crate::Real;

/// sin(n q + phi): a harmonic of the joint angle, n periods a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngularHarmonic<T> {
    /// Waves per turn, n.
    pub order: T,
    /// Phase phi at angle zero [rad].
    pub phase_rad: T,
}

impl<T: Real> AngularHarmonic<T> {
    /// The wave at an angle, in [-1, 1].
    #[inline]
    pub fn sine(&self, q_rad: T) -> T {
        (self.order * q_rad + self.phase_rad).sin_cos().0
    }
}
