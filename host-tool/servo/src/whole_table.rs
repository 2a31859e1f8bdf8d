//! Effects of the whole arm as tables of a model file.

use files::EffectTable;
use model::chain::SerialChain;

use crate::error::ServoError;
use crate::whole_arm::Whole;

/// An effect's parameters by the catalogue's names: name, values, whether they are a vector.
pub fn parameters(effect: Whole, values: &[f64]) -> Vec<(&'static str, Vec<f64>, bool)> {
    match effect {
        Whole::Payload => {
            vec![("mass_kg", values[..1].to_vec(), false), ("com_m", values[1..].to_vec(), true)]
        }
        Whole::TipForce => vec![("force_N", values.to_vec(), true)],
        Whole::BaseTilt => vec![
            ("tilt_x_rad", values[..1].to_vec(), false),
            ("tilt_y_rad", values[1..].to_vec(), false),
        ],
    }
}

/// An effect as a table of a model file.
pub fn table(effect: Whole, values: &[f64]) -> EffectTable {
    let value = |(name, values, is_vector): (&str, Vec<f64>, bool)| {
        let values: Vec<toml::Value> = values.into_iter().map(toml::Value::Float).collect();
        let single = values.first().cloned().unwrap_or(toml::Value::Float(0.0));
        (name.to_owned(), if is_vector { toml::Value::Array(values) } else { single })
    };
    EffectTable {
        effect: effect.name().to_owned(),
        joint: 0,
        parameters: parameters(effect, values).into_iter().map(value).collect(),
        extra: toml::Table::new(),
    }
}

/// The links with the payloads and tilts of a model file.
///
/// # Errors
/// Another effect of the whole arm, or a parameter that is missing.
pub fn with_effects(
    links: &SerialChain<f64>,
    tables: &[EffectTable],
) -> Result<SerialChain<f64>, ServoError> {
    let mut changed = *links;
    for table in tables.iter().filter(|table| table.joint == 0) {
        let unknown = || ServoError::Effect(table.effect.clone());
        let effect = [Whole::Payload, Whole::BaseTilt]
            .into_iter()
            .find(|effect| effect.name() == table.effect)
            .ok_or_else(unknown)?;
        let count = if effect == Whole::Payload { 4 } else { 2 };
        let mut values = Vec::new();
        for (name, ..) in parameters(effect, &vec![0.0; count]) {
            let value = table.parameters.get(name).ok_or_else(unknown)?;
            match value.as_array() {
                Some(array) => values.extend(array.iter().filter_map(toml::Value::as_float)),
                None => values.extend(value.as_float()),
            }
        }
        if values.len() != count {
            return Err(unknown());
        }
        changed = effect.links(&changed, &values);
    }
    Ok(changed)
}
