//! Waves of voltage that are what a wave of friction leaves.
//!
//! Friction that varies over the turn and is of another law than the model's leaves something at its order that does not
//! turn with the direction. As a voltage of that order it gains much, and is none.

use rig::effects::{Carrier, Search};
use rig::plant::Gear;

use crate::trial::hypothesis::EffectInstance;

/// Whether a wave of voltage has the order of one of friction on its joint, and takes less than the part `most` of what that
/// takes; each effect with its share.
pub fn is_left_by_friction(
    (voltage, share): (&EffectInstance, f64),
    (friction, of_friction): (&EffectInstance, f64),
    most: f64,
    gears: &[Gear],
) -> bool {
    let are_of = |one, other| is_of(voltage, one) && is_of(friction, other);
    are_of(Carrier::Unity, Carrier::Friction)
        && share < most * of_friction
        && voltage.is_of_order_of(friction, gears)
}

/// Whether an effect is a wave of this carrier.
fn is_of(effect: &EffectInstance, carrier: Carrier) -> bool {
    matches!(effect.definition.search, Search::Harmonics(own) if own == carrier)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::test_effects::wave;

    /// Whether the first of two waves with these shares is left by the other, on joints with such a gear.
    fn is_left(
        first: &EffectInstance,
        second: EffectInstance,
        shares: [f64; 2],
        gear: f64,
    ) -> bool {
        let gears = [Gear { motor: gear, ..Gear::DIRECT }; 3];
        is_left_by_friction((first, shares[0]), (&second, shares[1]), 0.5, &gears)
    }

    #[test]
    fn a_smaller_wave_of_voltage_at_the_order_of_one_of_friction_is_left_by_that() {
        let cogging = wave("cogging", 3, 9.1);
        let friction = |joint, order| wave("position_friction", joint, order);
        assert!(is_left(&cogging, friction(3, 9.0), [0.05, 0.57], 1.0));
        assert!(!is_left(&cogging, friction(3, 9.0), [0.4, 0.57], 1.0), "nearly as large");
        assert!(!is_left(&cogging, friction(3, 7.0), [0.05, 0.57], 1.0), "another order");
        assert!(!is_left(&cogging, friction(2, 9.0), [0.05, 0.57], 1.0), "another joint");
        let ripple = wave("torque_ripple", 3, 9.0);
        assert!(!is_left(&cogging, ripple.clone(), [0.05, 0.57], 1.0), "magnets make both");
        assert!(!is_left(&ripple, friction(3, 9.0), [0.05, 0.57], 1.0), "turns with the command");
    }

    #[test]
    fn orders_are_compared_per_turn_of_the_joint() {
        let (cogging, friction) = (wave("cogging", 3, 2.0), wave("position_friction", 3, 100.0));
        assert!(is_left(&cogging, friction.clone(), [0.05, 0.57], -50.0));
        assert!(!is_left(&cogging, friction, [0.05, 0.57], 1.0));
    }
}
