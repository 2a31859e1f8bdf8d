//! Motions of one joint.

use serde::{Deserialize, Serialize};

use super::{ConstantVelocity, FourierSeries, Time};
use crate::Angle;

/// Where a joint shall be, and how fast.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Setpoint {
    /// Angle within the turn.
    pub angle: Angle,
    /// The same on the turn that the motion's own numbers name, as exact as an `f32` [rad].
    pub position_rad: f32,
    /// Velocity [rad/s].
    pub velocity_rad_per_s: f32,
    /// Acceleration [rad/s^2].
    pub acceleration_rad_per_s2: f32,
}

impl Setpoint {
    /// At rest at an angle.
    pub fn at_rest(position_rad: f32) -> Self {
        Self { angle: Angle::from_radians(position_rad), position_rad, ..Self::default() }
    }

    /// Where a joint shall be `time_s` after its motion ended in this setpoint: it
    /// brakes to rest within half a second, on a velocity that falls as a parabola.
    #[inline]
    pub fn brought_to_rest(&self, time_s: f32) -> Self {
        const BRAKING_S: f32 = 0.5;
        let x = time_s * (1.0 / BRAKING_S);
        let rest = if x < 1.0 { 1.0 - x } else { 0.0 };
        let travel_s = BRAKING_S / 3.0 * (1.0 - rest * rest * rest);
        let travel_rad = self.velocity_rad_per_s * travel_s;
        Self {
            angle: self.angle.plus(travel_rad),
            position_rad: self.position_rad + travel_rad,
            velocity_rad_per_s: self.velocity_rad_per_s * rest * rest,
            acceleration_rad_per_s2: -2.0 / BRAKING_S * self.velocity_rad_per_s * rest,
        }
    }

    /// The same motion a short time earlier, at this acceleration.
    #[inline]
    pub fn earlier(&self, time_s: f32) -> Self {
        let gained = self.acceleration_rad_per_s2 * time_s;
        let travel_rad = (0.5 * gained - self.velocity_rad_per_s) * time_s;
        Self {
            angle: self.angle.plus(travel_rad),
            position_rad: self.position_rad + travel_rad,
            velocity_rad_per_s: self.velocity_rad_per_s - gained,
            ..*self
        }
    }
}

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
    /// The sine of eq. (20)-(21).
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

/// q = centre + amplitude sin(2 pi t / period), eq. (20), swelling over `fade_in`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sine {
    /// Centre, q_ref(0) of eq. (21) [rad].
    pub centre_rad: f32,
    /// Amplitude [rad].
    pub amplitude_rad: f32,
    /// Period [s], taken as a whole number of ticks.
    pub period_s: f32,
    /// How it begins.
    pub fade_in: FadeIn,
}

impl Sine {
    #[inline]
    fn at(&self, time: Time) -> Setpoint {
        let angular_rad_per_s = core::f32::consts::TAU / self.period_s;
        let (sine, cosine) = sin_cos_of_cycle(time.fraction_of_cycle(self.period_s));
        let wave = Wave {
            value: self.amplitude_rad * sine,
            slope: self.amplitude_rad * angular_rad_per_s * cosine,
            curvature: -self.amplitude_rad * angular_rad_per_s * angular_rad_per_s * sine,
        };
        self.fade_in.apply(wave, time).about(self.centre_rad)
    }
}

/// Sine and cosine of a fraction of a cycle in [0, 1).
#[inline]
pub(super) fn sin_cos_of_cycle(fraction: f32) -> (f32, f32) {
    Angle(((fraction * 4_294_967_296.0) as u32) as i32).sin_cos()
}

/// A wave that swells from nothing, so that the arm may begin at rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FadeIn {
    /// Time until the wave is whole [s]; 0 begins at once.
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

    /// The setpoint that swings so about a centre.
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
