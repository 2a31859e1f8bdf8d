//! The effects and kinds that cases are drawn from.

use super::case::Kind;
use super::cause::TrueCause;
use super::error::TrialError;
use super::{Rng, foreign};
use rig::effects::{CATALOGUE, Definition};

/// The effects to choose from.
#[derive(Debug)]
pub(super) struct Population {
    catalogue: Vec<&'static Definition>,
    foreign: Vec<&'static foreign::Definition>,
    kinds: Vec<(Kind, f64)>,
}

impl Population {
    /// Those of a kind, if one is named, and with these effects; of all where `only` is empty.
    ///
    /// # Errors
    /// An unknown name.
    pub(super) fn of(kind: Option<Kind>, only: &[String]) -> Result<Self, TrialError> {
        let is_unknown = |name: &&String| {
            Definition::by_name(name).is_none() && foreign::by_name(name).is_none()
        };
        if let Some(name) = only.iter().find(is_unknown) {
            return Err(TrialError::UnknownEffect(name.clone()));
        }
        let wanted = |name: &str| only.is_empty() || only.iter().any(|n| n == name);
        let mut population = Self {
            catalogue: CATALOGUE.into_iter().filter(|d| wanted(d.name)).collect(),
            foreign: foreign::ALL.into_iter().filter(|d| wanted(d.name)).collect(),
            kinds: Vec::new(),
        };
        population.kinds = population.kinds(kind, only);
        population.fill_up();
        Ok(population)
    }

    /// The kind that is named, or those that the effects named allow.
    fn kinds(&self, kind: Option<Kind>, only: &[String]) -> Vec<(Kind, f64)> {
        if let Some(kind) = kind {
            return vec![(kind, 1.0)];
        }
        let possible = |kind: Kind| match kind {
            _ if only.is_empty() => true,
            Kind::None | Kind::Pair => false,
            Kind::Single => !self.catalogue.is_empty(),
            Kind::Foreign => !self.foreign.is_empty(),
        };
        Kind::ALL.into_iter().filter(|(kind, _)| possible(*kind)).collect()
    }

    /// A kind without any of the effects named takes all that it has.
    fn fill_up(&mut self) {
        if self.catalogue.is_empty() {
            self.catalogue = CATALOGUE.to_vec();
        }
        if self.foreign.is_empty() {
            self.foreign = foreign::ALL.to_vec();
        }
    }

    /// A kind, drawn by its share.
    pub(super) fn draw_kind(&self, rng: &mut Rng) -> Kind {
        let whole: f64 = self.kinds.iter().map(|(_, share)| share).sum();
        let mut rest = rng.unit() * whole;
        for (kind, share) in &self.kinds {
            rest -= share;
            if rest <= 0.0 {
                return *kind;
            }
        }
        self.kinds.last().map_or(Kind::None, |(kind, _)| *kind)
    }

    /// An effect and its joint, evenly among those that the kind has; one that may stand
    /// beside another that is given.
    pub(super) fn draw_effect(
        &self,
        kind: Kind,
        other: Option<&TrueCause>,
        rng: &mut Rng,
    ) -> (DrawnEffect, u8) {
        let joint = rng.joint();
        if kind == Kind::Foreign {
            let definition: &'static _ = *rng.pick(&self.foreign);
            return (DrawnEffect::Foreign(definition), joint);
        }
        let different = |d: &&&'static Definition| other.is_none_or(|o| may_join(d, joint, o));
        let mut choices: Vec<_> = self.catalogue.iter().filter(different).copied().collect();
        if choices.is_empty() {
            choices = CATALOGUE.iter().filter(different).copied().collect();
        }
        let definition = *rng.pick(&choices);
        (DrawnEffect::Catalogue(definition), if definition.whole_robot { 0 } else { joint })
    }
}

/// An effect that was drawn, without its values.
pub(super) enum DrawnEffect {
    /// Of the catalogue.
    Catalogue(&'static Definition),
    /// Foreign to it.
    Foreign(&'static foreign::Definition),
}

/// Whether an effect is a pair with another: a different one, and not the same thing under
/// another name on the same joint.
fn may_join(definition: &Definition, joint: u8, other: &TrueCause) -> bool {
    const SAME: [[&str; 2]; 4] = [
        ["actuator_lag", "delay"],
        ["joint_elasticity", "backlash"],
        ["payload", "tip_force"],
        ["position_friction", "load_friction"],
    ];
    let same_place = definition.whole_robot || joint == other.joint;
    let alike = |[a, b]: [&str; 2]| {
        (definition.name == a && other.effect == b) || (definition.name == b && other.effect == a)
    };
    definition.name != other.effect && !(same_place && SAME.into_iter().any(alike))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twins_under_two_names_are_no_pair() {
        let of = |name| Definition::by_name(name).unwrap();
        let lag = TrueCause::of_catalogue(of("actuator_lag"), 2, vec![0.005]);
        assert!(!may_join(of("delay"), 2, &lag));
        assert!(may_join(of("delay"), 3, &lag));
        assert!(!may_join(of("actuator_lag"), 3, &lag), "the same effect twice");
        assert!(may_join(of("cogging"), 2, &lag));
        let force = TrueCause::of_catalogue(of("tip_force"), 0, vec![1.0, 0.0, 0.0]);
        assert!(!may_join(of("payload"), 1, &force));
    }
}
