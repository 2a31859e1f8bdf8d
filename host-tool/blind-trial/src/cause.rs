//! What a case's robot does that its model does not hold.

use std::collections::BTreeMap;

use serde::Serialize;

use super::foreign;
use super::rng::Rng;
use diagnosis::{Cause, Value};
use rig::effects::{Definition, DrawContext, Effect, EffectError, Parameter};

/// An effect as a kind, of the catalogue or foreign to it.
#[derive(Clone, Copy, Debug)]
pub enum TrueEffect {
    /// One of the catalogue.
    Catalogue(&'static Definition),
    /// One that the catalogue does not have.
    Foreign(&'static foreign::Definition),
}

impl TrueEffect {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Catalogue(definition) => definition.name,
            Self::Foreign(definition) => definition.name,
        }
    }

    /// Values for its parameters, as large as the plain trial draws them.
    pub fn draw(self, context: &DrawContext, random: &mut Rng) -> Vec<f64> {
        match self {
            Self::Catalogue(definition) => (definition.draw)(context, random),
            Self::Foreign(definition) => (definition.draw)(context.joint, random),
        }
    }

    /// The names of its parameters; components of a vector bear the same.
    fn parameter_names(self) -> Vec<&'static str> {
        match self {
            Self::Catalogue(definition) => definition.parameters.iter().map(|p| p.name).collect(),
            Self::Foreign(definition) => definition.parameters.to_vec(),
        }
    }
}

impl PartialEq for TrueEffect {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

/// A true cause, of the catalogue or foreign to it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TrueCause {
    /// Its name.
    pub effect: String,
    /// Joint, 1 to 3; 0 for the whole robot.
    pub joint: u8,
    /// Its parameters by name.
    pub parameters: BTreeMap<String, Value>,
    /// Values in the order of the definition's parameters.
    #[serde(skip)]
    values: Vec<f64>,
    /// What it is.
    #[serde(skip)]
    pub kind: TrueEffect,
}

impl TrueCause {
    /// An effect with values in the order of its parameters.
    pub fn new(kind: TrueEffect, joint: u8, values: Vec<f64>) -> Self {
        Self {
            effect: kind.name().to_owned(),
            joint,
            parameters: by_name(&kind.parameter_names(), &values),
            values,
            kind,
        }
    }

    /// Whether the catalogue does not have it.
    pub fn is_foreign(&self) -> bool {
        matches!(self.kind, TrueEffect::Foreign(_))
    }

    /// Its parameters as the catalogue knows them; none where it is foreign.
    pub fn known_parameters(&self) -> &'static [Parameter] {
        match self.kind {
            TrueEffect::Catalogue(definition) => definition.parameters,
            TrueEffect::Foreign(_) => &[],
        }
    }

    /// What it does to the simulated robot.
    ///
    /// # Errors
    /// Values that the effect does not take.
    pub fn build(&self) -> Result<Box<dyn Effect>, EffectError> {
        match self.kind {
            TrueEffect::Catalogue(definition) => definition.with(self.joint, &self.values),
            TrueEffect::Foreign(definition) => {
                Ok((definition.build)(usize::from(self.joint.max(1)) - 1, &self.values))
            }
        }
    }

    /// Whether a cause that was named is this one: effect and joint.
    pub fn is(&self, named: &Cause) -> bool {
        self.effect == named.effect && self.joint == named.joint
    }

    /// "cogging of joint 3", or "payload".
    pub fn words(&self) -> String {
        words(&self.effect, self.joint)
    }
}

/// An effect and where it acts, in words.
pub fn words(effect: &str, joint: u8) -> String {
    if joint == 0 { effect.to_owned() } else { format!("{effect} of joint {joint}") }
}

/// Values that share a name are a vector.
fn by_name(names: &[&str], values: &[f64]) -> BTreeMap<String, Value> {
    let mut vectors: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for (name, &value) in names.iter().zip(values) {
        vectors.entry((*name).to_owned()).or_default().push(value);
    }
    let value = |values: Vec<f64>| match values[..] {
        [single] => Value::Number(single),
        _ => Value::Vector(values),
    };
    vectors.into_iter().map(|(name, values)| (name, value(values))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rig::effects::Catalogue;

    #[test]
    fn components_of_a_vector_stand_together() {
        let force = TrueEffect::Catalogue(Catalogue::standard().by_name("tip_force").unwrap());
        let cause = TrueCause::new(force, 0, vec![1.0, 2.0, 3.0]);
        assert_eq!(cause.parameters["force_N"], Value::Vector(vec![1.0, 2.0, 3.0]));
        cause.build().unwrap();
    }
}
