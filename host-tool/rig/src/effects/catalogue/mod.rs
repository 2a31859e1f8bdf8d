//! The effects, one file each, and the catalogue in which they are looked up.

mod actuator_lag;
mod asymmetric_friction;
mod backlash;
mod base_tilt;
mod cable_spring;
mod cogging;
mod contact;
mod dac_offset;
mod dead_zone;
mod delay;
mod encoder_eccentricity;
mod encoder_offset;
mod friction_drift;
mod joint_elasticity;
mod load_friction;
mod payload;
mod position_friction;
mod quadratic_drag;
mod saturation;
mod stribeck;
mod tip_force;
mod torque_constant;
mod torque_ripple;
mod viscous_asymmetry;

use super::definition::{BOARD_JOINTS, Definition};

/// The project's effects, in the order in which files and reports list them.
const STANDARD: [&Definition; 20] = [
    &torque_constant::DEFINITION,
    &actuator_lag::DEFINITION,
    &delay::DEFINITION,
    &position_friction::DEFINITION,
    &cogging::DEFINITION,
    &torque_ripple::DEFINITION,
    &payload::DEFINITION,
    &tip_force::DEFINITION,
    &base_tilt::DEFINITION,
    &joint_elasticity::DEFINITION,
    &backlash::DEFINITION,
    &asymmetric_friction::DEFINITION,
    &load_friction::DEFINITION,
    &friction_drift::DEFINITION,
    &cable_spring::DEFINITION,
    &dac_offset::DEFINITION,
    &saturation::DEFINITION,
    &dead_zone::DEFINITION,
    &encoder_eccentricity::DEFINITION,
    &quadratic_drag::DEFINITION,
];

/// Those that are others on an arm of any kind.
const OF_ARM: [&Definition; 9] = [
    &payload::OF_ARM,
    &base_tilt::OF_ARM,
    &quadratic_drag::OF_ARM,
    &cogging::OF_ARM,
    &cable_spring::OF_ARM,
    &dac_offset::OF_ARM,
    &dead_zone::OF_ARM,
    &saturation::OF_ARM,
    &load_friction::OF_ARM,
];

/// Those that only an arm of any kind has: what measured machines demand beyond the board's robot.
const ONLY_OF_ARM: [&Definition; 4] = [
    &stribeck::DEFINITION,
    &viscous_asymmetry::DEFINITION,
    &encoder_offset::DEFINITION,
    &contact::DEFINITION,
];

/// Effects, looked up by their names.
#[derive(Clone, Debug)]
pub struct Catalogue {
    definitions: Vec<&'static Definition>,
    joints: u8,
}

impl Catalogue {
    /// The project's effects.
    pub fn standard() -> Self {
        Self { definitions: STANDARD.to_vec(), joints: BOARD_JOINTS }
    }

    /// The project's effects on an arm of so many joints, in terms of its last link and of its
    /// gravity where they are those of the whole robot.
    pub fn of_arm(joints: usize) -> Self {
        let general = |definition: &&'static Definition| {
            let of_arm = OF_ARM.iter().find(|general| general.name == definition.name);
            of_arm.copied().unwrap_or(definition)
        };
        let definitions = STANDARD.iter().map(general).chain(ONLY_OF_ARM).collect();
        Self { definitions, joints: joints as u8 }
    }

    /// Of how many joints the robot is.
    pub fn joints(&self) -> u8 {
        self.joints
    }

    /// The same effects and one more.
    pub fn with(mut self, definition: &'static Definition) -> Self {
        self.definitions.push(definition);
        self
    }

    /// All effects, in order.
    pub fn iter(&self) -> impl Iterator<Item = &'static Definition> {
        self.definitions.iter().copied()
    }

    /// The effect of that name.
    pub fn by_name(&self, name: &str) -> Option<&'static Definition> {
        self.iter().find(|definition| definition.name == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{Confused, Confusion};

    #[test]
    fn every_effect_has_another_name_and_finite_bounds() {
        let all: Vec<_> = Catalogue::of_arm(3).iter().collect();
        for (index, definition) in all.iter().enumerate() {
            assert!(all[..index].iter().all(|other| other.name != definition.name));
            for parameter in definition.parameters {
                assert!(parameter.lowest < parameter.highest, "{}", definition.name);
            }
        }
    }

    #[test]
    fn what_an_effect_is_confused_with_is_another_one() {
        let catalogue = Catalogue::of_arm(3);
        for definition in catalogue.iter() {
            for confusion in definition.confused_with {
                let Confused::Effect(other) = confusion.with else { continue };
                let other = catalogue.by_name(other).unwrap_or_else(|| panic!("{other}"));
                assert_ne!(other.name, definition.name);
                let back = |c: &Confusion| c.with == Confused::Effect(definition.name);
                assert!(!other.confused_with.iter().any(back), "{} twice", other.name);
            }
        }
    }
}
