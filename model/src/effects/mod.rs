//! What a real robot does beyond eq. (1) and (9), and what undoes it.
//!
//! Each effect stands here once, for the simulated robot that has it and for the
//! controller that makes up for it. u is the command, w the voltage that the motor
//! gets, q the joint, n a harmonic per turn.
//!
//! | function | effect |
//! | --- | --- |
//! | [`torque_constant_factor`], [`ripple_factor`], [`dead_zone`] | w from u, the first two as factors |
//! | [`dead_zone_command`] | u from w |
//! | [`cogging_v`], [`cable_spring_v`], [`quadratic_drag_v`] | added to w, whatever u is |
//! | [`vary_friction`], [`favour_a_direction`] | change the friction of eq. (9) |
//! | [`Tilt`], [`Posture::tip_force_torque`] | torques from outside |
//! | [`with_payload`] | base parameters with a mass at the tip |
//!
//! [`Posture::tip_force_torque`]: crate::Posture::tip_force_torque

mod command;
mod friction;
mod outside;
mod payload;
mod voltage;

pub use command::{dead_zone, dead_zone_command, ripple_factor, torque_constant_factor};
pub use friction::{favour_a_direction, vary_friction};
pub use outside::Tilt;
pub use payload::with_payload;
pub use voltage::{cable_spring_v, cogging_v, quadratic_drag_v};

use crate::Real;

/// sin(n q + phi): the wave that a motor or a joint repeats n times a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnWave<T> {
    /// Waves per turn, n.
    pub harmonic: T,
    /// Phase phi at angle zero [rad].
    pub phase_rad: T,
}

impl<T: Real> TurnWave<T> {
    /// The wave at an angle, in [-1, 1].
    #[inline]
    pub fn sine(&self, q_rad: T) -> T {
        (self.harmonic * q_rad + self.phase_rad).sin_cos().0
    }
}
