//! The effects and kinds that cases are drawn from.

use super::case::Kind;
use super::cause::{TrueCause, TrueEffect};
use super::error::TrialError;
use super::settings::DrawSettings;
use super::{Rng, foreign};
use rig::effects::{Catalogue, Definition, Random};

/// The effects to choose from.
#[derive(Debug)]
pub(super) struct Population {
    /// All that may stand beside another.
    whole: Vec<&'static Definition>,
    /// Those wanted of them.
    catalogue: Vec<&'static Definition>,
    foreign: Vec<&'static foreign::Definition>,
    kinds: Vec<(Kind, f64)>,
}

impl Population {
    /// Those of a kind, if one is named, and with these effects; of all where `only` is empty.
    ///
    /// # Errors
    /// An unknown name.
    pub(super) fn of(settings: &DrawSettings, catalogue: &Catalogue) -> Result<Self, TrialError> {
        let unknown =
            |name: &&String| catalogue.by_name(name).is_none() && foreign::by_name(name).is_none();
        if let Some(name) = settings.only.iter().find(unknown) {
            return Err(TrialError::UnknownEffect(name.clone()));
        }
        let wanted =
            |name: &str| settings.only.is_empty() || settings.only.iter().any(|n| n == name);
        let named = |d: &&foreign::Definition| settings.only.iter().any(|n| n == d.name);
        let shapes = foreign::SHAPES.into_iter().filter(named);
        let mut population = Self {
            whole: catalogue.iter().collect(),
            catalogue: catalogue.iter().filter(|d| wanted(d.name)).collect(),
            foreign: foreign::ALL.into_iter().filter(|d| wanted(d.name)).chain(shapes).collect(),
            kinds: Vec::new(),
        };
        population.kinds = population.kinds(settings.kind, &settings.only);
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
            self.catalogue = self.whole.clone();
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
    ) -> (TrueEffect, u8) {
        let joint = rng.joint();
        if kind == Kind::Foreign {
            let definition: &'static _ = *rng.pick(&self.foreign);
            return (TrueEffect::Foreign(definition), joint);
        }
        let different = |d: &&&'static Definition| other.is_none_or(|o| may_join(d, joint, o));
        let mut choices: Vec<_> = self.catalogue.iter().filter(different).copied().collect();
        if choices.is_empty() {
            choices = self.whole.iter().filter(different).copied().collect();
        }
        let definition = *rng.pick(&choices);
        (TrueEffect::Catalogue(definition), if definition.whole_robot { 0 } else { joint })
    }
}

/// Whether an effect is a pair with another: a different one, and not the same thing under
/// another name on the same joint.
fn may_join(definition: &Definition, joint: u8, other: &TrueCause) -> bool {
    let TrueEffect::Catalogue(known) = other.kind else { return true };
    let same_place = definition.whole_robot || joint == other.joint;
    definition.name != known.name && !(same_place && definition.is_twin_of(known))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twins_under_two_names_are_no_pair() {
        let of = |name| Catalogue::standard().by_name(name).unwrap();
        let cause =
            |name, joint, values| TrueCause::new(TrueEffect::Catalogue(of(name)), joint, values);
        let lag = cause("actuator_lag", 2, vec![0.005]);
        assert!(!may_join(of("delay"), 2, &lag));
        assert!(may_join(of("delay"), 3, &lag));
        assert!(!may_join(of("actuator_lag"), 3, &lag), "the same effect twice");
        assert!(may_join(of("cogging"), 2, &lag));
        let force = cause("tip_force", 0, vec![1.0, 0.0, 0.0]);
        assert!(!may_join(of("payload"), 1, &force));
    }
}
