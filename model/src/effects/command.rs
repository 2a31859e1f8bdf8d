//! Effects between command and motor.

use crate::Real;

/// w / u of a motor whose torque constant is 1 + e times the model's.
#[inline]
pub fn torque_constant_factor<T: Real>(relative_error: T) -> T {
    T::one() + relative_error
}

/// w / u where the torque constant varies over the turn: 1 + a sin(n q + phi).
#[inline]
pub fn ripple_factor<T: Real>(relative_amplitude: T, sine: T) -> T {
    T::one() + relative_amplitude * sine
}

/// Output of an amplifier with a dead zone: sgn(u) max(|u| - d, 0) [V].
#[inline]
pub fn dead_zone<T: Real>(command_v: T, half_width_v: T) -> T {
    (command_v.abs() - half_width_v).max(T::zero()) * command_v.signum()
}

/// The inverse of a [`dead_zone`]: the command w + sgn(w) d [V], 0 for 0.
#[inline]
pub fn dead_zone_inverse<T: Real>(voltage_v: T, half_width_v: T) -> T {
    if voltage_v > T::zero() {
        voltage_v + half_width_v
    } else if voltage_v < T::zero() {
        voltage_v - half_width_v
    } else {
        T::zero()
    }
}
