//! Motions of one joint.

use serde::{Deserialize, Serialize};

use super::constant_velocity::ConstantVelocity;
use super::fourier::FourierSeries;
use super::setpoint::Setpoint;
use super::sine::Sine;
use super::time::Time;
use super::wave::Wave;

/// The motion of one joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Motion {
    /// Stay at an angle.
    Hold {
        /// The angle [rad].
        angle_rad: f32,
    },
    /// A fifth-order polynomial from rest to rest.
    Quintic {
        /// Start [rad].
        from_rad: f32,
        /// End [rad].
        to_rad: f32,
        /// Time it takes [s].
        duration_s: f32,
    },
    /// The sine of the validation motion, eq. (20)-(21).
    Sine(Sine),
    /// The five-term Fourier series of section 4.2.
    Fourier(FourierSeries),
    /// Legs at constant velocity, there and back.
    ConstantVelocity(ConstantVelocity),
}

impl Motion {
    /// The setpoint in the middle of a tick's interval.
    #[inline]
    pub fn at(&self, time: Time) -> Setpoint {
        match self {
            Self::Hold { angle_rad } => Setpoint::at_rest(*angle_rad),
            Self::Quintic { from_rad, to_rad, duration_s } => {
                Wave::step(to_rad - from_rad, *duration_s, time).about(*from_rad)
            }
            Self::Sine(sine) => sine.at(time),
            Self::Fourier(series) => series.at(time),
            Self::ConstantVelocity(legs) => legs.at(time),
        }
    }
}
