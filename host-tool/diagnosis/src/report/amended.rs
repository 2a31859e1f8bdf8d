//! The model file with what was found in it.

use std::collections::BTreeMap;

use crate::logs::subject::Subject;
use crate::result::Value;
use crate::trial::hypothesis::{EffectInstance, Hypothesis};
use files::{EffectTable, RobotFile};
use rig::effects::Table;

/// The model file with refitted parameters, the effects and the tables.
pub fn amended(subject: &Subject, file: &RobotFile, hypothesis: &Hypothesis) -> RobotFile {
    let effect = |effect: &EffectInstance| EffectTable {
        effect: effect.definition.name.into(),
        joint: subject.outer_joint(effect.joint),
        parameters: parameters(effect).into_iter().map(|(k, v)| (k, as_toml(v))).collect(),
        ..EffectTable::default()
    };
    let table = |table: &Table| {
        Table { joint: subject.outer_joint(table.joint), ..table.clone() }.to_effect_table()
    };
    let mut amended = subject.refitted_file(file, &hypothesis.robot);
    amended.effects = hypothesis.effects.iter().map(effect).collect();
    amended.effects.extend(hypothesis.tables.iter().map(table));
    amended
}

/// An effect's parameters by name, components of a vector together.
pub fn parameters(effect: &EffectInstance) -> BTreeMap<String, Value> {
    let mut all = BTreeMap::<String, Value>::new();
    for (parameter, &value) in effect.definition.parameters.iter().zip(&effect.values) {
        if parameter.optional && value == 0.0 {
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

fn as_toml(value: Value) -> toml::Value {
    match value {
        Value::Number(number) => toml::Value::Float(number),
        Value::Vector(values) => {
            toml::Value::Array(values.into_iter().map(toml::Value::Float).collect())
        }
    }
}
