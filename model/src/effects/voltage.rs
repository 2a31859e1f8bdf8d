//! Disturbances at the motor, as equivalent voltages [V].

use crate::Real;

/// Cogging torque of the magnets: A sin(n q + phi) [V].
#[inline]
pub fn cogging_v<T: Real>(amplitude_v: T, sine: T) -> T {
    amplitude_v * sine
}

/// Torque of cables towards a rest angle: -k (q - q0) [V].
#[inline]
pub fn cable_spring_v<T: Real>(stiffness_v_per_rad: T, q_rad: T, rest_rad: T) -> T {
    -stiffness_v_per_rad * (q_rad - rest_rad)
}

/// Drag of air or of a fan: -b qd |qd| [V].
#[inline]
pub fn quadratic_drag_v<T: Real>(coefficient_v_s2_per_rad2: T, velocity_rad_per_s: T) -> T {
    -coefficient_v_s2_per_rad2 * velocity_rad_per_s * velocity_rad_per_s.abs()
}
