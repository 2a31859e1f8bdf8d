//! What a search ends with.

use super::objection::{Objection, objection};
use super::refit::Finalist;
use crate::fit::fitted_model::FittedModel;
use crate::fit::preparation::as_given;
use crate::logs::subject::Subject;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};

/// What the search ends with.
pub struct Selection {
    /// The refitted model.
    pub refitted: FittedModel,
    /// The model with all effects that were added.
    pub last: FittedModel,
    /// The added effects, in the order of the last model's.
    pub added: Vec<Added>,
    /// Candidates that were not accepted at the end, the best first.
    pub refused: Vec<Rival>,
}

/// An effect that was added.
#[derive(Clone)]
pub struct Added {
    /// Log-likelihood that the last model loses without it.
    pub gain: f64,
    /// The last model without it.
    pub without: FittedModel,
    /// What else was tried in its place, the best first.
    pub rivals: Vec<Rival>,
}

/// A candidate that was not added.
#[derive(Clone)]
pub struct Rival {
    /// The effect, refitted with everything else.
    pub effect: EffectInstance,
    /// Log-likelihood by which the model with it is worse than the one with the effect in its
    /// place, or better than the last one where it was refused.
    pub gain: f64,
    /// The model with it.
    pub model: FittedModel,
    /// What speaks against it; nothing where another did better.
    pub objection: Option<Objection>,
}

/// An effect that is known before a search.
#[derive(Clone)]
pub struct Known {
    /// The effect.
    pub effect: EffectInstance,
    /// What it gained where it was found.
    pub gain: f64,
    /// What else was tried in its place.
    pub rivals: Vec<EffectInstance>,
}

impl Known {
    /// Whether a model holds one of two effects: they are one cause, or springs on one joint.
    pub fn excludes(&self, other: &Self) -> bool {
        let (own, other) = (&self.effect, &other.effect);
        let both_springs = own.is_spring() && other.is_spring() && own.joint == other.joint;
        both_springs || own.is_same_cause(other)
    }
}

/// Effects that are known before a search.
#[derive(Clone, Default)]
pub struct KnownCauses {
    /// Each of them.
    pub causes: Vec<Known>,
    /// A model that they were found in, or most of them, where there is one.
    pub found_in: Option<Box<Hypothesis>>,
}

impl KnownCauses {
    /// Effects that nothing was tried against.
    pub fn alone(effects: &[EffectInstance]) -> Self {
        let alone = |effect: &EffectInstance| Known {
            effect: effect.clone(),
            gain: 0.0,
            rivals: Vec::new(),
        };
        Self { causes: effects.iter().map(alone).collect(), found_in: None }
    }

    /// Effects that a subject is suspected to have, in the model as given.
    pub fn suspected_of(subject: &Subject) -> Self {
        let effects: Vec<_> = subject.suspected.iter().map(EffectInstance::told).collect();
        Self { found_in: Some(Box::new(as_given(subject))), ..Self::alone(&effects) }
    }

    /// These behind the effects that a subject is suspected to have, where there are any.
    pub fn behind_suspected(self, subject: &Subject) -> Self {
        match subject.suspected.is_empty() {
            true => self,
            false => Self::suspected_of(subject).and(self),
        }
    }

    /// These, and those of others that they do not exclude; a search begins from the model of the others, too.
    pub fn and(mut self, others: Self) -> Self {
        for other in others.causes {
            if !self.causes.iter().any(|own| own.excludes(&other)) {
                self.causes.push(other);
            }
        }
        Self { found_in: others.found_in, ..self }
    }
}

impl Selection {
    /// The effects that were added, for another search.
    pub fn known(&self, subject: &Subject) -> KnownCauses {
        let effects = &self.last.linear.hypothesis.effects[subject.known_effects.len()..];
        let known = |(added, effect): (&Added, &EffectInstance)| Known {
            effect: effect.clone(),
            gain: added.gain,
            rivals: added.rivals.iter().map(|rival| rival.effect.clone()).collect(),
        };
        let causes = self.added.iter().zip(effects).map(known).collect();
        KnownCauses { causes, found_in: Some(Box::new(self.last.linear.hypothesis.clone())) }
    }

    /// Whether all of these effects are in the last model.
    pub fn holds(&self, effects: &[EffectInstance]) -> bool {
        effects.iter().all(|effect| self.has(effect))
    }

    /// Whether one of these effects at least is.
    pub fn holds_one(&self, effects: &[EffectInstance]) -> bool {
        effects.iter().any(|effect| self.has(effect))
    }

    fn has(&self, effect: &EffectInstance) -> bool {
        let last = &self.last.linear.hypothesis.effects;
        let name = |of: &EffectInstance| (of.definition.name, of.joint);
        last.iter().any(|other| name(other) == name(effect))
    }

    /// The refitted model alone; what was added counts as refused.
    pub fn without_effects(self) -> Self {
        let last = self.refitted.clone();
        Self { last, added: Vec::new(), ..self }
    }
}

impl Rival {
    /// A finalist that was refused beside the effects of the model `before`.
    pub fn refused(finalist: Finalist, before: &FittedModel, subject: &Subject) -> Self {
        let Finalist { effect, gain, model } = finalist;
        let objection = objection(before, &model, &subject.criteria);
        Self { effect, gain, model, objection: objection.or(Some(Objection::Unsettled)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rig::effects::Catalogue;

    fn effect(name: &str, joint: u8, size: f64) -> EffectInstance {
        let catalogue = Catalogue::standard();
        let definition =
            catalogue.iter().find(|d| d.name == name).expect("an effect of the catalogue");
        let mut values = vec![1.0; definition.parameters.len()];
        values[0] = size;
        EffectInstance { definition, joint, values }
    }

    #[test]
    fn causes_of_two_searches_are_each_once_and_the_first_ones_stay() {
        let first =
            KnownCauses::alone(&[effect("backlash", 3, 0.002), effect("dac_offset", 1, 0.1)]);
        let second = KnownCauses::alone(&[
            effect("joint_elasticity", 3, 90.0),
            effect("dac_offset", 1, 0.3),
            effect("cogging", 2, 0.1),
        ]);
        let both = first.and(second).causes;
        let names: Vec<_> = both.iter().map(|known| known.effect.definition.name).collect();
        assert_eq!(names, ["backlash", "dac_offset", "cogging"]);
        assert_eq!(both[1].effect.values[0], 0.1);
    }

    #[test]
    fn a_cause_takes_the_values_of_the_model_that_it_was_found_in() {
        let found = [effect("backlash", 3, 0.006), effect("dac_offset", 1, 0.1)];
        assert_eq!(effect("backlash", 3, 0.002).as_in(&found).values[0], 0.006);
        assert_eq!(effect("backlash", 2, 0.002).as_in(&found).values[0], 0.002);
    }
}
