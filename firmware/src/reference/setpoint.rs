//! Desired position, velocity and acceleration of a joint at an instant.

use crate::Angle;

/// Desired position, velocity and acceleration of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Setpoint {
    /// Angle within the turn.
    pub angle: Angle,
    /// The same angle, turns included, to the precision of an `f32` [rad].
    pub position_rad: f32,
    /// Velocity [rad/s].
    pub velocity_rad_per_s: f32,
    /// Acceleration [rad/s^2].
    pub acceleration_rad_per_s2: f32,
}

/// Time in which a joint brakes at the end of a reference [s].
pub const BRAKING_S: f32 = 0.5;
/// Shortest and longest time of a controlled stop [s].
const SHORTEST_S: f32 = 0.05;
const LONGEST_S: f32 = 1.0;

/// The time of a controlled stop with at most this deceleration [s]: it is greatest at first,
/// 2 v / T.
pub fn braking_time_s(velocity_rad_per_s: f32, deceleration_rad_per_s2: f32) -> f32 {
    let time_s = 2.0 * velocity_rad_per_s.abs() / deceleration_rad_per_s2;
    time_s.clamp(SHORTEST_S, LONGEST_S)
}

/// What passes until a joint brakes [s]: two ticks, and what it still accelerates meanwhile.
const REACTION_S: f32 = 0.01;

/// The distance that a joint covers until then, v T / 3, and before it reacts [rad].
#[inline]
pub fn braking_distance_rad(velocity_rad_per_s: f32, deceleration_rad_per_s2: f32) -> f32 {
    let time_s = braking_time_s(velocity_rad_per_s, deceleration_rad_per_s2);
    velocity_rad_per_s.abs() * (time_s * (1.0 / 3.0) + REACTION_S)
}

impl Setpoint {
    /// At rest at an angle.
    pub fn at_rest(position_rad: f32) -> Self {
        Self { angle: Angle::from_radians(position_rad), position_rad, ..Self::default() }
    }

    /// The setpoint `time_s` after the motion ended in this one: the joint brakes to rest within
    /// `braking_s`, its velocity falling as a parabola.
    #[inline]
    pub fn brought_to_rest(&self, time_s: f32, braking_s: f32) -> Self {
        let x = time_s * (1.0 / braking_s);
        let rest = if x < 1.0 { 1.0 - x } else { 0.0 };
        let travel_s = braking_s / 3.0 * (1.0 - rest * rest * rest);
        let travel_rad = self.velocity_rad_per_s * travel_s;
        Self {
            angle: self.angle.plus(travel_rad),
            position_rad: self.position_rad + travel_rad,
            velocity_rad_per_s: self.velocity_rad_per_s * rest * rest,
            acceleration_rad_per_s2: -2.0 / braking_s * self.velocity_rad_per_s * rest,
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
