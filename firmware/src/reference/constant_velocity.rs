//! Legs at constant velocity, for static friction (section 3.1).

use heapless::Vec;
use serde::{Deserialize, Serialize};

use super::setpoint::Setpoint;
use super::time::Time;
use crate::Angle;

/// The most speeds in one run.
pub const MAX_SPEEDS: usize = 16;

/// For each speed a leg forwards and a leg back to the start, with ramps at both ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConstantVelocity {
    /// Where each pair of legs begins and ends [rad].
    pub start_rad: f32,
    /// Speeds [rad/s], one pair of legs each; after the last it begins again.
    pub speeds_rad_per_s: Vec<f32, MAX_SPEEDS>,
    /// Time of one leg with its ramps [s].
    pub leg_s: f32,
    /// Time of each ramp [s], at most half the leg.
    pub ramp_s: f32,
}

impl ConstantVelocity {
    /// The setpoint in the middle of a tick's interval.
    #[inline]
    pub(super) fn at(&self, time: Time) -> Setpoint {
        let leg_ticks = time.ticks_in(self.leg_s);
        let leg = (time.tick / leg_ticks) as usize;
        let pairs = self.speeds_rad_per_s.len().max(1);
        let speed = self.speeds_rad_per_s.get((leg / 2) % pairs).copied().unwrap_or(0.0);
        let in_leg = Time { tick: time.tick % leg_ticks, ..time };
        let (travel_s, velocity, acceleration) = self.trapezoid(in_leg.seconds());
        let (start_rad, speed) = if leg.is_multiple_of(2) {
            (self.start_rad, speed)
        } else {
            (self.start_rad + speed * (self.leg_s - self.ramp_s), -speed)
        };
        let position_rad = start_rad + speed * travel_s;
        Setpoint {
            angle: Angle::from_radians(position_rad),
            position_rad,
            velocity_rad_per_s: speed * velocity,
            acceleration_rad_per_s2: speed * acceleration,
        }
    }

    /// Travel, velocity and acceleration at unit speed, after `time_s` of a leg.
    #[inline]
    fn trapezoid(&self, time_s: f32) -> (f32, f32, f32) {
        let left_s = self.leg_s - time_s;
        if time_s < self.ramp_s {
            (0.5 * time_s * time_s / self.ramp_s, time_s / self.ramp_s, 1.0 / self.ramp_s)
        } else if left_s < self.ramp_s {
            let whole_s = self.leg_s - self.ramp_s;
            let missing_s = 0.5 * left_s * left_s / self.ramp_s;
            (whole_s - missing_s, left_s / self.ramp_s, -1.0 / self.ramp_s)
        } else {
            (time_s - 0.5 * self.ramp_s, 1.0, 0.0)
        }
    }
}
