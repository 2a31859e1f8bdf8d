//! Friction that depends on position or on direction.

use crate::Real;
use crate::friction::FrictionScale;

/// Friction whose level varies over the turn: gamma (1 + a sin(n q + phi)).
#[inline]
pub fn scale_position_friction<T: Real>(
    scale: &mut FrictionScale<T>,
    relative_amplitude: T,
    sine: T,
) {
    scale.level = scale.level * (T::one() + relative_amplitude * sine);
}

/// Friction, level and viscous part, times 1 + e forwards and 1 - e backwards.
#[inline]
pub fn scale_asymmetric_friction<T: Real>(
    scale: &mut FrictionScale<T>,
    relative_asymmetry: T,
    velocity_rad_per_s: T,
) {
    let backwards = velocity_rad_per_s < T::zero();
    let factor = T::one() + if backwards { -relative_asymmetry } else { relative_asymmetry };
    scale.level = scale.level * factor;
    scale.viscous = scale.viscous * factor;
}
