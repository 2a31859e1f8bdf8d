//! Effects that the catalogue does not have but that resemble some that it has: what an
//! honest diagnosis calls unknown. One file each.

mod cogging_series;
mod cross_talk;
mod definition;
mod detent;
mod fading_torque;
mod friction_patches;
mod hardening_spring;
mod hysteresis_spring;
mod hysteretic_cable;
mod mains_hum;
mod rubbing_backlash;
mod second_order_lag;
mod slew_rate;
mod uneven_gain;
mod wandering_torque;

pub use definition::Definition;

/// Those of the plain trial.
pub const ALL: [&Definition; 9] = [
    &mains_hum::DEFINITION,
    &slew_rate::DEFINITION,
    &uneven_gain::DEFINITION,
    &hysteresis_spring::DEFINITION,
    &hardening_spring::DEFINITION,
    &detent::DEFINITION,
    &cross_talk::DEFINITION,
    &fading_torque::DEFINITION,
    &wandering_torque::DEFINITION,
];

/// Effects of the catalogue in another shape, which the diverse trial hides beside [`ALL`]: what
/// they are `equivalent` to is as right an answer.
pub const SHAPES: [&Definition; 5] = [
    &cogging_series::DEFINITION,
    &second_order_lag::DEFINITION,
    &rubbing_backlash::DEFINITION,
    &hysteretic_cable::DEFINITION,
    &friction_patches::DEFINITION,
];

/// The foreign effect of that name.
pub fn by_name(name: &str) -> Option<&'static Definition> {
    ALL.into_iter().chain(SHAPES).find(|definition| definition.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;
    use rig::effects::Catalogue;

    #[test]
    fn they_are_foreign_to_the_catalogue_and_resemble_what_it_has() {
        let catalogue = Catalogue::standard();
        for definition in ALL.into_iter().chain(SHAPES) {
            assert!(catalogue.by_name(definition.name).is_none());
            for name in definition.resembles.iter().chain(definition.equivalent) {
                assert!(catalogue.by_name(name).is_some(), "{name}");
            }
            let values = (definition.draw)(2, &mut Rng::new(1, 1));
            assert_eq!(values.len(), definition.parameters.len(), "{}", definition.name);
        }
    }
}
