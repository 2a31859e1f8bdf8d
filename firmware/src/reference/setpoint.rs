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

impl Setpoint {
    /// At rest at an angle.
    pub fn at_rest(position_rad: f32) -> Self {
        Self { angle: Angle::from_radians(position_rad), position_rad, ..Self::default() }
    }

    /// The setpoint `time_s` after the motion ended in this one: the joint brakes to rest within
    /// half a second, its velocity falling as a parabola.
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
