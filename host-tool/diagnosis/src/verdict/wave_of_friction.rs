//! Waves of voltage that are what a wave of friction leaves.
//!
//! Friction that varies over the turn and is of another law than the model's leaves something at its order that does not
//! turn with the direction. As a voltage of that order it gains much, and is none.

use rig::plant::Gear;

use super::judged::Judged;
use crate::trial::hypothesis::EffectInstance;

/// Whether the effect at `index` is a wave of voltage, and one of friction with the same order on the same joint takes a
/// larger share with it.
pub fn is_left_by_friction(
    effects: &[EffectInstance],
    judged: &[Judged],
    index: usize,
    gears: &[Gear],
) -> bool {
    let effect = &effects[index];
    let is_larger = |other: &Judged| other.share_with_it > judged[index].share_with_it;
    let mut others = effects.iter().zip(judged);
    others.any(|(other, worth)| is_larger(worth) && have_one_order(effect, other, gears))
}

/// Whether one is a wave of voltage and the other one of friction, of one order on one joint.
fn have_one_order(voltage: &EffectInstance, friction: &EffectInstance, gears: &[Gear]) -> bool {
    let are = voltage.definition.touches.drive && friction.definition.touches.friction;
    are && voltage.is_of_order_of(friction, gears)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::worth::Worth;
    use rig::effects::{Catalogue, Kind};

    fn wave(name: &str, joint: u8, order: f64) -> EffectInstance {
        let definition = Catalogue::standard().by_name(name).unwrap();
        let value = |kind| if kind == Kind::Harmonic { order } else { 0.1 };
        let values = definition.parameters.iter().map(|p| value(p.kind)).collect();
        EffectInstance { definition, joint, values }
    }

    fn with_share(share_with_it: f64) -> Judged {
        let worth = Worth {
            share: 0.1,
            share_interval: [0.0, 0.2],
            remainder: 0.1,
            part_of_left: 0.5,
            shrinkage: 0.1,
            shrinkage_interval: [0.05, 0.2],
        };
        Judged { worth, weighed: worth, probability: 0.9, counts_in_full: true, share_with_it }
    }

    /// Of waves with these shares the first.
    fn is_left(
        first: &EffectInstance,
        second: EffectInstance,
        shares: [f64; 2],
        gear: f64,
    ) -> bool {
        let gears = [Gear { motor: gear, ..Gear::DIRECT }; 3];
        is_left_by_friction(&[first.clone(), second], &shares.map(with_share), 0, &gears)
    }

    #[test]
    fn a_smaller_wave_of_voltage_at_the_order_of_one_of_friction_is_left_by_that() {
        let cogging = wave("cogging", 3, 9.1);
        let friction = |joint, order| wave("position_friction", joint, order);
        assert!(is_left(&cogging, friction(3, 9.0), [0.05, 0.57], 1.0));
        assert!(!is_left(&cogging, friction(3, 9.0), [0.57, 0.05], 1.0), "the larger one");
        assert!(!is_left(&cogging, friction(3, 7.0), [0.05, 0.57], 1.0), "another order");
        assert!(!is_left(&cogging, friction(2, 9.0), [0.05, 0.57], 1.0), "another joint");
        let ripple = wave("torque_ripple", 3, 9.0);
        assert!(!is_left(&cogging, ripple.clone(), [0.05, 0.57], 1.0), "magnets make both");
        assert!(is_left(&ripple, friction(3, 9.0), [0.05, 0.57], 1.0));
    }

    #[test]
    fn orders_are_compared_per_turn_of_the_joint() {
        let (cogging, friction) = (wave("cogging", 3, 2.0), wave("position_friction", 3, 100.0));
        assert!(is_left(&cogging, friction.clone(), [0.05, 0.57], -50.0));
        assert!(!is_left(&cogging, friction, [0.05, 0.57], 1.0));
    }
}
