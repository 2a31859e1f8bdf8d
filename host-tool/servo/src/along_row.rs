//! What the rigid body asks of one joint about where it stands.

use crate::step::Load;

/// The rigid body along one joint at one row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AlongRow {
    /// The links' inertia about the joint [kg m^2; kg].
    pub inertia: f64,
    /// Where the joint stands [rad; m].
    pub position: f64,
    /// Gravity's torque there, less the part that stays when it turns [Nm].
    pub gravity: f64,
    /// Its slope there [Nm/rad].
    pub slope: f64,
    /// The part of gravity that stays when the joint turns [Nm; N].
    pub constant: f64,
    /// Coriolis torque, and what the other joints' accelerations ask [Nm; N].
    pub coupling: f64,
}

impl AlongRow {
    /// The load at a distance from there, gravity multiplied.
    #[inline]
    pub fn load(&self, distance: f64, gravity: f64) -> Load {
        let (sine, cosine) = small_sin_cos(distance);
        let turned = self.gravity * cosine + self.slope * sine;
        Load {
            inertia: self.inertia,
            torque: gravity * (self.constant + turned) + self.coupling,
            slope: gravity * (self.slope * cosine - self.gravity * sine),
        }
    }
}

/// Sine and cosine, by polynomials where the angle is small.
#[inline]
fn small_sin_cos(x: f64) -> (f64, f64) {
    if x.abs() > 0.3 {
        return x.sin_cos();
    }
    let s = x * x;
    (x * (1.0 - s / 6.0 * (1.0 - s / 20.0)), 1.0 - s / 2.0 * (1.0 - s / 12.0 * (1.0 - s / 30.0)))
}
