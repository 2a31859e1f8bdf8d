//! Effects from a model file's `[[effect]]` tables and from the command line.

use super::catalogue::Catalogue;
use super::definition::Definition;
use super::effect::Effect;
use super::error::EffectError;
use super::table::{self, Table};
use files::EffectTable;

impl Definition {
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
                None if parameter.optional => {
                    let components = self.parameters.iter().filter(|p| p.name == parameter.name);
                    values.extend(components.map(|_| 0.0));
                }
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

impl Catalogue {
    /// The effect that a table of a model file describes.
    ///
    /// # Errors
    /// An unknown name, or parameters that do not fit.
    pub fn effect_of(&self, table: &EffectTable) -> Result<Box<dyn Effect>, EffectError> {
        if Table::is_in(table) {
            return Ok(Box::new(Table::on_one_of(self.joints(), table)?));
        }
        let (definition, values) = self.definition_and_values(table)?;
        definition.on_one_of(self.joints(), table.joint, &values)
    }

    /// The kind of effect that a table describes, and its values in the order of the kind's
    /// parameters; a [`Table`] is of no kind, ask [`Table::is_in`] first.
    ///
    /// # Errors
    /// An unknown name, or parameters that do not fit.
    pub fn definition_and_values(
        &self,
        table: &EffectTable,
    ) -> Result<(&'static Definition, Vec<f64>), EffectError> {
        let definition = self.by_name(&table.effect).ok_or_else(|| self.unknown(&table.effect))?;
        Ok((definition, definition.values(&table.parameters)?))
    }

    /// The refusal of a name that no effect has.
    fn unknown(&self, name: &str) -> EffectError {
        let causes = self.iter().map(|definition| definition.name);
        let known: Vec<&str> = causes.chain([table::NAME]).collect();
        EffectError::Unknown { name: name.to_owned(), known: known.join(", ") }
    }
}

/// The table that `effect:joint:name=value,name=value` describes; a vector's components stand
/// between spaces, and joint 0 may be left out. The axis of a table is a word.
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

/// `name=value`, or `name=x y z`, or `axis=word`.
fn parameter(pair: &str) -> Option<(String, toml::Value)> {
    let (name, value) = pair.split_once('=')?;
    if name.trim() == table::AXIS {
        return Some((table::AXIS.to_owned(), toml::Value::String(value.trim().to_owned())));
    }
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
        table
            .and_then(|table| Catalogue::standard().effect_of(&table))
            .map(|_| ())
            .unwrap_err()
            .to_string()
    }

    #[test]
    fn effects_are_read_from_the_command_line() {
        for text in [
            "cogging:3:amplitude_V=0.11,harmonic=8,phase_rad=0.9",
            "payload:mass_kg=0.3",
            "payload:0:mass_kg=0.3",
            "tip_force:force_N=1 0 -2",
        ] {
            Catalogue::standard().effect_of(&table_from_text(text).unwrap()).unwrap();
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
