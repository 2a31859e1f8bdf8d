//! Settings that override defaults: TOML tables of numbers, without a format number, for a key
//! that is not known is refused.

use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::error::{FileError, Problem};
use super::toml_source::TomlSource;

/// A value that cannot be used.
#[derive(Clone, Debug, PartialEq)]
pub struct OutOfRange {
    /// Its table.
    pub table: String,
    /// Its key.
    pub key: String,
    /// What is wrong with it.
    pub what: String,
}

/// Reads settings that `check` finds nothing wrong with.
///
/// # Errors
/// Names the file and line, what is wrong, and the cure.
pub fn read<T: DeserializeOwned>(
    path: &Path,
    check: impl Fn(&T) -> Option<OutOfRange>,
) -> Result<T, FileError> {
    let source = TomlSource::without_format(path)?;
    let settings: T = source.parse().map_err(|error| match error.problem {
        Problem::Toml(words) if words.starts_with("unknown field") => {
            FileError { problem: Problem::Setting(words), ..error }
        }
        problem => FileError { problem, ..error },
    })?;
    match check(&settings) {
        None => Ok(settings),
        Some(OutOfRange { table, key, what }) => {
            let problem = Problem::Setting(format!("{key}: {what}"));
            Err(source.problem_in(problem, &table, None, &key))
        }
    }
}

/// The first number in the tables of settings that is not positive.
pub fn not_positive(settings: &impl Serialize) -> Option<OutOfRange> {
    let tables = toml::Table::try_from(settings).ok()?;
    tables.iter().find_map(|(table, keys)| {
        keys.as_table()?.iter().find_map(|(key, value)| {
            let number = value.as_float().or(value.as_integer().map(|whole| whole as f64))?;
            let what = format!("{value} is not positive");
            (number <= 0.0).then(|| OutOfRange { table: table.clone(), key: key.clone(), what })
        })
    })
}
