//! Robot and model files from TOML.

use std::path::Path;

use model::{BaseParameters, base};
use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use super::keys::KEYS;
use super::tables::as_number;
use super::{EffectTable, FrictionTable, PendulumTable, RobotFile, RobotTable};
use crate::error::{FileError, Problem};
use crate::known_keys;
use crate::toml_source::{ARM_FORMAT, TomlSource};

/// The tables that are known here; the rest of the file is found by comparison.
#[derive(Deserialize)]
struct Known {
    robot: RobotTable,
    base: Option<Table>,
    pendulum: Option<PendulumTable>,
    #[serde(default)]
    friction: Vec<FrictionTable>,
    #[serde(default)]
    effect: Vec<EffectTable>,
}

const KNOWN_TABLES: [&str; 6] = ["format", "robot", "base", "pendulum", "friction", "effect"];

impl RobotFile {
    /// Reads a file.
    ///
    /// # Errors
    /// Names the file and line, what is wrong, and a remedy.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, FileError> {
        TomlSource::read(path.as_ref()).map_err(arm_of_any_kind).and_then(of)
    }

    /// The same from a file's bytes; the path is for messages.
    ///
    /// # Errors
    /// As of [`RobotFile::read`].
    pub fn parse(path: impl AsRef<Path>, bytes: Vec<u8>) -> Result<Self, FileError> {
        TomlSource::of(path.as_ref(), bytes).map_err(arm_of_any_kind).and_then(of)
    }
}

/// Names what a file of the general format is.
fn arm_of_any_kind(error: FileError) -> FileError {
    match error.problem {
        Problem::UnknownFormat(ARM_FORMAT) => FileError { problem: Problem::ArmOfAnyKind, ..error },
        problem => FileError { problem, ..error },
    }
}

fn of(source: TomlSource) -> Result<RobotFile, FileError> {
    known_keys::check(&source, &KEYS)?;
    let mut file = file_from(&source)?;
    file.source = source;
    file.check()?;
    Ok(file)
}

fn file_from(source: &TomlSource) -> Result<RobotFile, FileError> {
    let mut known: Known = source.parse()?;
    let mut all: Table = source.parse()?;
    known.robot.extra = extra(all.get("robot"), &known.robot);
    if let Some(pendulum) = &mut known.pendulum {
        pendulum.extra = extra(all.get("pendulum"), pendulum);
    }
    for (index, friction) in known.friction.iter_mut().enumerate() {
        friction.extra = extra(nth(&all, "friction", index), friction);
    }
    for (index, effect) in known.effect.iter_mut().enumerate() {
        effect.extra = extra(nth(&all, "effect", index), effect);
    }
    all.retain(|key, _| !KNOWN_TABLES.contains(&key));
    let mut base_extra = known.base.clone().unwrap_or_default();
    base_extra.retain(|key, _| !base::NAMES.contains(&key));
    Ok(RobotFile {
        base: known.base.map(|table| base_from(&table, source)).transpose()?,
        base_extra,
        robot: known.robot,
        pendulum: known.pendulum,
        friction: known.friction,
        effects: known.effect,
        extra: all,
        source: TomlSource::default(),
    })
}

/// The 16 base parameters; keys beside them are no error.
fn base_from(table: &Table, source: &TomlSource) -> Result<BaseParameters<f64>, FileError> {
    let mut values = [0.0; base::COUNT];
    for (value, name) in values.iter_mut().zip(base::NAMES) {
        let problem = match table.get(name).map(as_number) {
            Some(Some(number)) => {
                *value = number;
                continue;
            }
            Some(None) => Problem::Toml(format!("{name} must be a number")),
            None => Problem::MissingParameter(format!("{name} in [base]")),
        };
        return Err(source.problem_in(problem, "base", None, name));
    }
    Ok(BaseParameters::from_array(values))
}

fn nth<'a>(all: &'a Table, name: &str, index: usize) -> Option<&'a Value> {
    all.get(name)?.as_array()?.get(index)
}

/// The keys of a table that its type does not know: those that it does not write back.
fn extra(table: Option<&Value>, known: &impl Serialize) -> Table {
    let written = Table::try_from(known).unwrap_or_default();
    let mut rest = table.and_then(Value::as_table).cloned().unwrap_or_default();
    rest.retain(|key, _| !written.contains_key(key));
    rest
}
