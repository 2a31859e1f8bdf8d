//! A function of time with its derivatives, and its fade-in.

use serde::{Deserialize, Serialize};

use super::setpoint::Setpoint;
use super::time::Time;
use crate::Angle;

/// Sine and cosine of a fraction of a cycle in [0, 1).
#[inline]
pub(super) fn sin_cos_of_cycle(fraction: f32) -> (f32, f32) {
    Angle(((fraction * 4_294_967_296.0) as u32) as i32).sin_cos()
}

/// A rise of a wave's amplitude from zero, so that the arm begins at rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FadeIn {
    /// Time until the amplitude is reached [s]; 0 begins with it.
    pub duration_s: f32,
}

impl FadeIn {
    /// The wave times a quintic that rises from 0 to 1.
    #[inline]
    pub(super) fn apply(&self, wave: Wave, time: Time) -> Wave {
        if time.seconds() >= self.duration_s {
            return wave;
        }
        let swell = Wave::step(1.0, self.duration_s, time);
        Wave {
            value: swell.value * wave.value,
            slope: swell.slope * wave.value + swell.value * wave.slope,
            curvature: swell.curvature * wave.value
                + 2.0 * swell.slope * wave.slope
                + swell.value * wave.curvature,
        }
    }
}

/// A function of time with its first two derivatives [rad, rad/s, rad/s^2].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Wave {
    pub value: f32,
    pub slope: f32,
    pub curvature: f32,
}

impl Wave {
    /// A quintic rise from 0 to `height` over `duration_s`, at rest at both ends.
    #[inline]
    pub fn step(height: f32, duration_s: f32, time: Time) -> Self {
        let x = time.seconds() / duration_s;
        if x >= 1.0 {
            return Self { value: height, slope: 0.0, curvature: 0.0 };
        }
        let rest = 1.0 - x;
        Self {
            value: height * x * x * x * (10.0 + x * (6.0 * x - 15.0)),
            slope: height / duration_s * 30.0 * (x * rest) * (x * rest),
            curvature: height / (duration_s * duration_s) * 60.0 * x * rest * (1.0 - 2.0 * x),
        }
    }

    /// The setpoint of this wave about a centre.
    #[inline]
    pub fn about(self, centre_rad: f32) -> Setpoint {
        let position_rad = centre_rad + self.value;
        Setpoint {
            angle: Angle::from_radians(position_rad),
            position_rad,
            velocity_rad_per_s: self.slope,
            acceleration_rad_per_s2: self.curvature,
        }
    }
}
