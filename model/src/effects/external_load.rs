//! Torques of external loads: a tilted base, a force on the tip.

use serde::{Deserialize, Serialize};

use crate::vector::Vector3;
use crate::{BaseParameters, Geometry, Posture, Real};

/// A tilted base.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Tilt<T> {
    /// Change of the direction of gravity, in the base frame and in units of g.
    pub gravity_change: Vector3<T>,
    /// First moments about axis 1, along the arm's reach and across it [kg m]. With a level base
    /// they have no effect, so they are not among the 16 base parameters.
    pub hidden_moment_kg_m: [T; 2],
}

impl<T: Real> Tilt<T> {
    /// A base tilted by a about x and by b about y, under an arm with these moments:
    /// gravity changes by (sin b, -sin a cos b, 1 - cos a cos b).
    pub fn new(tilt_x_rad: T, tilt_y_rad: T, hidden_moment_kg_m: [T; 2]) -> Self {
        let ((sin_a, cos_a), (sin_b, cos_b)) = (tilt_x_rad.sin_cos(), tilt_y_rad.sin_cos());
        let gravity_change = [sin_b, -sin_a * cos_b, T::one() - cos_a * cos_b];
        Self { gravity_change, hidden_moment_kg_m }
    }

    /// The same in another number type.
    pub fn cast<U: Real>(&self) -> Tilt<U> {
        let cast = |x: T| U::constant(x.as_f64());
        Tilt {
            gravity_change: self.gravity_change.map(cast),
            hidden_moment_kg_m: self.hidden_moment_kg_m.map(cast),
        }
    }

    /// Torques of gravity less those on a level base [Nm], with the sine and cosine of q1.
    #[inline]
    pub fn torque(
        &self,
        sin_cos_q1: (T, T),
        posture: &Posture<T>,
        p: &BaseParameters<T>,
        geometry: &Geometry<T>,
    ) -> Vector3<T> {
        let [along, across, up] = to_arm_frame(&self.gravity_change, sin_cos_q1);
        let Posture { s2, c2, s23, c23, .. } = *posture;
        let arm = FirstMoment::rotated(p.mx2r, p.my2r, (s2, c2));
        let forearm = FirstMoment::rotated(p.mx3r, p.my3r, (s23, c23));
        let whole = arm.plus(forearm);
        let [reach, side] = self.hidden_moment_kg_m;
        let g = geometry.gravity_m_s2;
        let swing = |part: FirstMoment<T>| g * (up * part.level - along * part.upright);
        [g * (across * (whole.level + reach) - along * side), swing(whole), swing(forearm)]
    }
}

impl<T: Real> Posture<T> {
    /// Torques J^T F of a force on the tip [Nm], with the sine and cosine of q1 and the
    /// force in the base frame [N].
    #[inline]
    pub fn tip_force_torque(
        &self,
        sin_cos_q1: (T, T),
        geometry: &Geometry<T>,
        force_n: &Vector3<T>,
    ) -> Vector3<T> {
        let [along, across, up] = to_arm_frame(force_n, sin_cos_q1);
        let Geometry { d2_m, a2_m, d3_m, a3_m, .. } = *geometry;
        let reach_m = a2_m * self.c2 + a3_m * self.c23;
        let height_m = a2_m * self.s2 + a3_m * self.s23;
        [
            (d2_m + d3_m) * along + reach_m * across,
            reach_m * up - height_m * along,
            a3_m * (self.c23 * up - self.s23 * along),
        ]
    }
}

/// A vector of the base frame along the arm's reach, across it and up.
#[inline]
fn to_arm_frame<T: Real>(&[x, y, up]: &Vector3<T>, (s1, c1): (T, T)) -> Vector3<T> {
    [c1 * x + s1 * y, c1 * y - s1 * x, up]
}

/// First moment of a part of the arm, level and upright [kg m].
#[derive(Clone, Copy)]
struct FirstMoment<T> {
    level: T,
    upright: T,
}

impl<T: Real> FirstMoment<T> {
    #[inline]
    fn rotated(x: T, y: T, (sine, cosine): (T, T)) -> Self {
        Self { level: x * cosine - y * sine, upright: x * sine + y * cosine }
    }

    #[inline]
    fn plus(self, other: Self) -> Self {
        Self { level: self.level + other.level, upright: self.upright + other.upright }
    }
}
