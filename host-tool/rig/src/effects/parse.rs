//! Effects from a model file's `[[effect]]` tables and from the command line.

use super::{CATALOGUE, Definition, Effect};
use files::EffectTable;

/// Why an effect is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EffectError {
    /// No effect of the catalogue has this name.
    #[error("{0} is no effect; the catalogue has {list}", list = names())]
    Unknown(String),
    /// The effect acts elsewhere.
    #[error("{effect} acts on {right}, not on joint {joint}")]
    Joint {
        /// The effect.
        effect: &'static str,
        /// Where it acts.
        right: &'static str,
        /// The joint given.
        joint: u8,
    },
    /// A parameter is missing, or there is one too many.
    #[error("{effect} takes {expected}, but {found} is given")]
    Parameters {
        /// The effect.
        effect: &'static str,
        /// The parameters that it has.
        expected: String,
        /// Those given.
        found: String,
    },
    /// A value that is not a number, or out of bounds.
    #[error("{parameter} of {effect} is {value}, but must be from {lowest} to {highest}")]
    Value {
        /// The effect.
        effect: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// The value given.
        value: f64,
        /// The least allowed.
        lowest: f64,
        /// The most allowed.
        highest: f64,
    },
    /// Text of another form.
    #[error("`{0}` is not of the form effect:joint:name=value,name=value")]
    Form(String),
}

fn names() -> String {
    CATALOGUE.map(|definition| definition.name).join(", ")
}

impl Definition {
    pub(super) fn check(&self, joint: u8, values: &[f64]) -> Result<(), EffectError> {
        let right = if self.whole_robot { "the whole robot (joint 0)" } else { "joint 1, 2 or 3" };
        if self.whole_robot != (joint == 0) || joint > 3 {
            return Err(EffectError::Joint { effect: self.name, right, joint });
        }
        if values.len() != self.parameters.len() {
            return Err(self.wrong_parameters(format!("{} values", values.len())));
        }
        for (parameter, &value) in self.parameters.iter().zip(values) {
            if !(parameter.lowest..=parameter.highest).contains(&value) {
                return Err(EffectError::Value {
                    effect: self.name,
                    parameter: parameter.name,
                    value,
                    lowest: parameter.lowest,
                    highest: parameter.highest,
                });
            }
        }
        Ok(())
    }

    fn wrong_parameters(&self, found: String) -> EffectError {
        let mut expected: Vec<&str> = self.parameters.iter().map(|p| p.name).collect();
        expected.dedup();
        EffectError::Parameters { effect: self.name, expected: expected.join(", "), found }
    }

    /// Values in the order of the parameters, each taken by name.
    fn values(&self, table: &toml::Table) -> Result<Vec<f64>, EffectError> {
        let mut values = Vec::new();
        let mut names = Vec::new();
        for parameter in self.parameters {
            if names.contains(&parameter.name) {
                continue;
            }
            names.push(parameter.name);
            match table.get(parameter.name).map(numbers) {
                None if parameter.optional => values.push(0.0),
                given => values.extend(
                    given.flatten().ok_or_else(|| self.wrong_parameters(given_names(table)))?,
                ),
            }
        }
        if table.keys().any(|key| !names.contains(&key.as_str())) {
            return Err(self.wrong_parameters(given_names(table)));
        }
        Ok(values)
    }
}

fn given_names(table: &toml::Table) -> String {
    if table.is_empty() {
        return "nothing".into();
    }
    table.keys().cloned().collect::<Vec<_>>().join(", ")
}

/// A number or an array of numbers.
fn numbers(value: &toml::Value) -> Option<Vec<f64>> {
    let number = |value: &toml::Value| {
        value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
    };
    match value {
        toml::Value::Array(entries) => entries.iter().map(number).collect(),
        single => number(single).map(|number| vec![number]),
    }
}

/// The effect that a table of a model file describes.
///
/// # Errors
/// An unknown name, or parameters that do not fit.
pub fn effect_of(table: &EffectTable) -> Result<Box<dyn Effect>, EffectError> {
    let (definition, values) = definition_and_values(table)?;
    definition.with(table.joint, &values)
}

/// The kind of effect that a table describes, and its values in the order of the kind's
/// parameters.
///
/// # Errors
/// An unknown name, or parameters that do not fit.
pub fn definition_and_values(
    table: &EffectTable,
) -> Result<(&'static Definition, Vec<f64>), EffectError> {
    let definition = Definition::by_name(&table.effect)
        .ok_or_else(|| EffectError::Unknown(table.effect.clone()))?;
    Ok((definition, definition.values(&table.parameters)?))
}

/// The table that `effect:joint:name=value,name=value` describes; a vector's components stand
/// between spaces, and joint 0 may be left out.
///
/// # Errors
/// Text of another form.
pub fn table_from_text(text: &str) -> Result<EffectTable, EffectError> {
    let form = || EffectError::Form(text.to_owned());
    let mut parts = text.split(':');
    let effect = parts.next().unwrap_or_default().to_owned();
    let rest: Vec<&str> = parts.collect();
    let (joint, values) = match rest[..] {
        [] => (0, ""),
        [values] if values.contains('=') => (0, values),
        [joint] => (joint.parse().map_err(|_| form())?, ""),
        [joint, values] => (joint.parse().map_err(|_| form())?, values),
        _ => return Err(form()),
    };
    let pairs = values.split(',').filter(|pair| !pair.is_empty());
    let parameters: Option<toml::Table> = pairs.map(parameter).collect();
    Ok(EffectTable {
        effect,
        joint,
        parameters: parameters.ok_or_else(form)?,
        ..EffectTable::default()
    })
}

/// `name=value`, or `name=x y z`.
fn parameter(pair: &str) -> Option<(String, toml::Value)> {
    let (name, value) = pair.split_once('=')?;
    let numbers: Option<Vec<toml::Value>> =
        value.split_whitespace().map(|n| n.parse().ok().map(toml::Value::Float)).collect();
    let value = match numbers?.as_slice() {
        [] => return None,
        [single] => single.clone(),
        several => toml::Value::Array(several.to_vec()),
    };
    Some((name.trim().to_owned(), value))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> String {
        let table = table_from_text(text);
        table.and_then(|table| effect_of(&table)).map(|_| ()).unwrap_err().to_string()
    }

    #[test]
    fn effects_are_read_from_the_command_line() {
        for text in [
            "cogging:3:amplitude_V=0.11,harmonic=8,phase_rad=0.9",
            "payload:mass_kg=0.3",
            "payload:0:mass_kg=0.3",
            "tip_force:force_N=1 0 -2",
        ] {
            effect_of(&table_from_text(text).unwrap()).unwrap();
        }
    }

    #[test]
    fn what_is_wrong_is_named() {
        assert!(error("coggin:3:amplitude_V=0.1").contains("coggin is no effect"));
        assert!(error("cogging:3:amplitude_V=0.1").contains("amplitude_V, harmonic, phase_rad"));
        assert!(error("cogging:4:amplitude_V=0.1,harmonic=1,phase_rad=0").contains("joint 4"));
        assert!(error("payload:2:mass_kg=0.3").contains("the whole robot"));
        assert!(error("payload:mass_kg=-1").contains("mass_kg of payload is -1"));
        assert!(error("payload:mass_kg=nan").contains("mass_kg of payload is NaN"));
        assert!(error("payload:mass_kg=heavy").contains("not of the form"));
        assert!(error("payload").contains("nothing is given"));
    }
}
