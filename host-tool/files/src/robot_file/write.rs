//! Robot and model files to TOML.

use std::io::Write;
use std::path::Path;

use serde::Serialize;
use toml::{Table, Value};

use super::RobotFile;
use crate::error::{FileError, Problem};
use crate::replace::replace_file;
use crate::toml_source::FORMAT;

impl RobotFile {
    /// Writes a file, whole or not at all, its tables in the order of the contract.
    ///
    /// # Errors
    /// The path cannot be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), FileError> {
        let path = path.as_ref();
        let text = self.to_toml().map_err(|problem| problem.in_file(path))?;
        replace_file(path, |out| out.write_all(text.as_bytes()).map_err(Problem::Unwritable))
    }

    /// The file's text.
    ///
    /// # Errors
    /// A value that TOML cannot hold.
    pub fn to_toml(&self) -> Result<String, Problem> {
        text(self).map_err(|error| Problem::Toml(error.to_string()))
    }
}

/// The file's text: the format and bare keys first, then table by table.
fn text(file: &RobotFile) -> Result<String, toml::ser::Error> {
    let is_table = |value: &Value| value.is_table() || is_table_array(value);
    let (tables, keys): (Table, Table) =
        file.extra.clone().into_iter().partition(|(_, value)| is_table(value));
    let mut head = Table::from_iter([("format".to_owned(), Value::from(FORMAT))]);
    head.extend(keys);
    let mut sections = vec![toml::to_string(&head)?];
    for (name, value) in known_tables(file)?.into_iter().chain(tables) {
        sections.push(toml::to_string(&Table::from_iter([(name, value)]))?);
    }
    Ok(sections.join("\n"))
}

fn known_tables(file: &RobotFile) -> Result<Table, toml::ser::Error> {
    let mut tables = Table::new();
    tables.insert("robot".to_owned(), with_extra(&file.robot, &file.robot.extra)?);
    if let Some(base) = &file.base {
        tables.insert("base".to_owned(), with_extra(base, &file.base_extra)?);
    }
    if let Some(pendulum) = &file.pendulum {
        tables.insert("pendulum".to_owned(), with_extra(pendulum, &pendulum.extra)?);
    }
    let friction = file.friction.iter().map(|table| with_extra(table, &table.extra));
    insert_array(&mut tables, "friction", friction.collect::<Result<_, _>>()?);
    let effects = file.effects.iter().map(|table| with_extra(table, &table.extra));
    insert_array(&mut tables, "effect", effects.collect::<Result<_, _>>()?);
    Ok(tables)
}

fn insert_array(tables: &mut Table, name: &str, values: Vec<Value>) {
    if !values.is_empty() {
        tables.insert(name.to_owned(), Value::Array(values));
    }
}

fn with_extra(known: &impl Serialize, extra: &Table) -> Result<Value, toml::ser::Error> {
    let mut table = Table::try_from(known)?;
    table.extend(extra.clone());
    Ok(Value::Table(table))
}

fn is_table_array(value: &Value) -> bool {
    value.as_array().is_some_and(|values| !values.is_empty() && values.iter().all(Value::is_table))
}
