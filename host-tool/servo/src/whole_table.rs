//! Effects of the whole arm as tables of a model file.

use files::EffectTable;
use model::chain::SerialChain;

use crate::error::ServoError;
use crate::whole_effect::Whole;

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

/// The links with the payloads and tilts of a model file; forces are none of theirs.
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
        let named = |effect: &Whole| effect.name() == table.effect;
        let effect = Whole::ALL.into_iter().find(named).ok_or_else(unknown)?;
        changed = effect.links(&changed, &values(effect, table)?);
    }
    Ok(changed)
}

/// The force on the tip that a model file's tables tell, base frame [N].
///
/// # Errors
/// A parameter that is missing.
pub fn tip_force(tables: &[EffectTable]) -> Result<[f64; 3], ServoError> {
    let mut sum = [0.0; 3];
    let name = Whole::TipForce.name();
    for table in tables.iter().filter(|table| table.joint == 0 && table.effect == name) {
        let force = values(Whole::TipForce, table)?;
        sum.iter_mut().zip(&force).for_each(|(sum, force)| *sum += force);
    }
    Ok(sum)
}

/// An effect's values in the order of [`parameters`]; a payload is at the tip where its place is left out.
fn values(effect: Whole, table: &EffectTable) -> Result<Vec<f64>, ServoError> {
    let mut all = Vec::new();
    for (name, neutral, _) in parameters(effect, &[0.0; 4][..effect.count()]) {
        let value = table.parameters.get(name);
        let given = match value {
            None if name == "com_m" => Some(neutral.clone()),
            None => None,
            Some(value) => numbers(value),
        };
        let fits = |values: &Vec<f64>| values.len() == neutral.len();
        all.extend(given.filter(fits).ok_or_else(|| ServoError::Effect(table.effect.clone()))?);
    }
    Ok(all)
}

/// A number, or an array of them.
fn numbers(value: &toml::Value) -> Option<Vec<f64>> {
    let number = |value: &toml::Value| {
        value.as_float().or(value.as_integer().map(|whole| whole as f64)).filter(|x| x.is_finite())
    };
    match value {
        toml::Value::Array(entries) => entries.iter().map(number).collect(),
        single => number(single).map(|number| vec![number]),
    }
}
