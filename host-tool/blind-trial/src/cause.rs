//! What a case's robot does that its model does not hold.

use std::collections::BTreeMap;

use serde::Serialize;

use super::foreign;
use diagnosis::{Cause, Value};
use rig::effects::{Definition, Effect, EffectError};

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
    /// Whether the catalogue does not have it.
    #[serde(skip)]
    pub foreign: bool,
}

impl TrueCause {
    /// An effect of the catalogue with values in the order of its parameters.
    pub fn of_catalogue(definition: &Definition, joint: u8, values: Vec<f64>) -> Self {
        let names = definition.parameters.iter().map(|parameter| parameter.name);
        Self {
            effect: definition.name.to_owned(),
            joint,
            parameters: by_name(names, &values),
            values,
            foreign: false,
        }
    }

    /// An effect that the catalogue does not have.
    pub fn of_foreign(definition: &foreign::Definition, joint: u8, values: Vec<f64>) -> Self {
        Self {
            effect: definition.name.to_owned(),
            joint,
            parameters: by_name(definition.parameters.iter().copied(), &values),
            values,
            foreign: true,
        }
    }

    /// What it does to the simulated robot.
    ///
    /// # Errors
    /// A name or values that no effect has.
    pub fn build(&self) -> Result<Box<dyn Effect>, EffectError> {
        let unknown = || EffectError::Unknown(self.effect.clone());
        if self.foreign {
            let definition = foreign::by_name(&self.effect).ok_or_else(unknown)?;
            return Ok((definition.build)(usize::from(self.joint.max(1)) - 1, &self.values));
        }
        Definition::by_name(&self.effect).ok_or_else(unknown)?.with(self.joint, &self.values)
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
fn by_name<'a>(names: impl Iterator<Item = &'a str>, values: &[f64]) -> BTreeMap<String, Value> {
    let mut vectors: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for (name, &value) in names.zip(values) {
        vectors.entry(name.to_owned()).or_default().push(value);
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

    #[test]
    fn components_of_a_vector_stand_together() {
        let definition = Definition::by_name("tip_force").unwrap();
        let cause = TrueCause::of_catalogue(definition, 0, vec![1.0, 2.0, 3.0]);
        assert_eq!(cause.parameters["force_N"], Value::Vector(vec![1.0, 2.0, 3.0]));
        cause.build().unwrap();
    }
}
