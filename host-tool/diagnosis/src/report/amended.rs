//! The model file with what was found in it.

use std::collections::BTreeMap;

use crate::logs::subject::Subject;
use crate::model_file::ModelFile;
use crate::result::Value;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};
use files::EffectTable;
use rig::effects::Table;

/// The model file with refitted parameters, the effects and the tables; where friction differs from log to log, with its
/// mean over train logs.
pub fn amended(subject: &Subject, file: &ModelFile, hypothesis: &Hypothesis) -> ModelFile {
    let effect = |effect: &EffectInstance| EffectTable {
        effect: effect.definition.name.into(),
        joint: subject.outer_joint(effect.joint),
        parameters: parameters(effect).into_iter().map(|(k, v)| (k, as_toml(v))).collect(),
        ..EffectTable::default()
    };
    let table = |table: &Table| {
        Table { joint: subject.outer_joint(table.joint), ..table.clone() }.to_effect_table()
    };
    let mut amended = file.refitted(subject, &hypothesis.as_warm_as_usual());
    let of_gears = hypothesis.effects_of_gears();
    let effects = hypothesis.effects.iter().chain(&of_gears).map(effect);
    amended.set_effects(effects.chain(hypothesis.tables.iter().map(table)).collect());
    amended
}

/// An effect's parameters by name, components of a vector together.
pub fn parameters(effect: &EffectInstance) -> BTreeMap<String, Value> {
    let mut all = BTreeMap::<String, Value>::new();
    for (parameter, &value) in effect.definition.parameters.iter().zip(&effect.values) {
        if parameter.optional && is_zero(effect, parameter.name) {
            continue;
        }
        let entry = match all.remove(parameter.name) {
            None => Value::Number(value),
            Some(Value::Number(first)) => Value::Vector(vec![first, value]),
            Some(Value::Vector(mut values)) => {
                values.push(value);
                Value::Vector(values)
            }
        };
        all.insert(parameter.name.into(), entry);
    }
    all
}

/// Whether all components of a parameter are zero.
fn is_zero(effect: &EffectInstance, name: &str) -> bool {
    let mut both = effect.definition.parameters.iter().zip(&effect.values);
    both.all(|(parameter, value)| parameter.name != name || *value == 0.0)
}

fn as_toml(value: Value) -> toml::Value {
    match value {
        Value::Number(number) => toml::Value::Float(number),
        Value::Vector(values) => {
            toml::Value::Array(values.into_iter().map(toml::Value::Float).collect())
        }
    }
}
