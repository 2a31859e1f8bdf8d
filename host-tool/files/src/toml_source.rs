//! TOML text that remembers its file and lines.

use std::ops::Range;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeInteger, DeTable, DeValue};

use super::bytes;
use super::error::{FileError, Place, Problem};

/// The format of all files but those of arms of any kind.
pub(super) const FORMAT: i64 = 1;

/// The format of arms of any kind.
pub(super) const ARM_FORMAT: i64 = 2;

/// A TOML file's text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TomlSource {
    path: PathBuf,
    text: String,
}

impl Default for TomlSource {
    /// The source of values that were never in a file.
    fn default() -> Self {
        Self { path: "(unsaved)".into(), text: String::new() }
    }
}

impl TomlSource {
    /// Reads a file and checks its format number and that every number is finite.
    pub(super) fn read(path: &Path) -> Result<Self, FileError> {
        Self::of(path, bytes::read(path)?)
    }

    /// Checks the same in a file's bytes.
    pub(super) fn of(path: &Path, bytes: Vec<u8>) -> Result<Self, FileError> {
        Self::of_format(path, bytes, FORMAT)
    }

    /// The same where another format is wanted.
    pub(super) fn of_format(path: &Path, bytes: Vec<u8>, format: i64) -> Result<Self, FileError> {
        let source = Self { path: path.to_owned(), text: bytes::text(path, bytes)? };
        let document = source.document()?;
        source.check_format(document.get_ref(), format)?;
        source.check_finite("", document.get_ref())?;
        Ok(source)
    }

    /// The format number of a file's text, as far as it has one.
    pub(super) fn format_of(text: &str) -> Option<i64> {
        let document = DeTable::parse(text).ok()?;
        document.get_ref().get("format")?.get_ref().as_integer().and_then(whole)
    }

    /// Reads a file that may lack a format number, and checks that every number is finite.
    pub(super) fn without_format(path: &Path) -> Result<Self, FileError> {
        let source = Self { path: path.to_owned(), text: bytes::text(path, bytes::read(path)?)? };
        source.check_finite("", source.document()?.get_ref())?;
        Ok(source)
    }

    /// The file's values with their places.
    pub(super) fn document(&self) -> Result<Spanned<DeTable<'_>>, FileError> {
        DeTable::parse(&self.text).map_err(|error| self.syntax(&error))
    }

    /// The file's values.
    pub(super) fn parse<T: DeserializeOwned>(&self) -> Result<T, FileError> {
        toml::from_str(&self.text).map_err(|error| self.syntax(&error))
    }

    /// The file's text.
    pub(super) fn text(&self) -> &str {
        &self.text
    }

    /// Where the line after that of the format begins, or would.
    pub(super) fn line_end_of_format(&self) -> usize {
        let document = DeTable::parse(&self.text).ok();
        let value = document.as_ref().and_then(|document| document.get_ref().get("format"));
        let end = value.map_or(0, |value| value.span().end);
        let rest = self.text.get(end..).unwrap_or_default();
        rest.find('\n').map_or(self.text.len() + 1, |length| end + length + 1)
    }

    /// A problem of the whole file.
    pub(super) fn problem(&self, problem: Problem) -> FileError {
        problem.in_file(&self.path)
    }

    /// A problem in a table: at the line of `key`, or of the table where it lacks the
    /// key. `joint` chooses among tables of the same name.
    pub(super) fn problem_in(
        &self,
        problem: Problem,
        table: &str,
        joint: Option<u8>,
        key: &str,
    ) -> FileError {
        let place = Place { line: self.line_of(table, joint, key), column: None };
        problem.at(place).in_file(&self.path)
    }

    /// A problem in the `index`-th table of a name.
    pub(super) fn problem_in_nth(&self, problem: Problem, table: &str, index: usize) -> FileError {
        let document = DeTable::parse(&self.text).ok();
        let tables = document.as_ref().map(|document| tables(document.get_ref(), table));
        let span = tables.and_then(|tables| tables.get(index).map(|table| table.span()));
        match span {
            Some(span) => self.problem_at(problem, span),
            None => self.problem(problem),
        }
    }

    fn line_of(&self, table: &str, joint: Option<u8>, key: &str) -> Option<usize> {
        let document = DeTable::parse(&self.text).ok()?;
        let tables = tables(document.get_ref(), table);
        let table = tables.into_iter().find(|table| {
            joint.is_none_or(|number| joint_of(table.get_ref()) == Some(i64::from(number)))
        })?;
        let value = table.get_ref().as_table().and_then(|keys| keys.get(key));
        Some(self.line_at(value.unwrap_or(table).span()))
    }

    fn line_at(&self, span: Range<usize>) -> usize {
        bytes::line_at_end(&self.text.as_bytes()[..span.start.min(self.text.len())])
    }

    /// A problem at a range of bytes.
    pub(super) fn problem_at(&self, problem: Problem, span: Range<usize>) -> FileError {
        problem.at(Place::line(self.line_at(span))).in_file(&self.path)
    }

    fn syntax(&self, error: &toml::de::Error) -> FileError {
        // The parser's messages may run over several lines; the user gets one.
        let words = error.message().lines().map(str::trim).collect::<Vec<_>>().join(", ");
        let problem = Problem::Toml(words);
        match error.span() {
            Some(span) => self.problem_at(problem, span),
            None => self.problem(problem),
        }
    }

    fn check_format(&self, document: &DeTable, wanted: i64) -> Result<(), FileError> {
        let Some(value) = document.get("format") else {
            let missing = format!("`format = {wanted}`");
            return Err(self.problem(Problem::MissingParameter(missing)));
        };
        let problem = match value.get_ref().as_integer().and_then(whole) {
            Some(format) if format == wanted => return Ok(()),
            Some(other) => Problem::UnknownFormat(other),
            None => Problem::Toml("format must be a whole number".to_owned()),
        };
        Err(self.problem_at(problem, value.span()))
    }

    fn check_finite(&self, name: &str, table: &DeTable) -> Result<(), FileError> {
        table.iter().try_for_each(|(key, value)| {
            let name = [name, key.get_ref()].join(if name.is_empty() { "" } else { "." });
            self.check_finite_value(&name, value)
        })
    }

    fn check_finite_value(&self, name: &str, value: &Spanned<DeValue>) -> Result<(), FileError> {
        match value.get_ref() {
            DeValue::Table(table) => self.check_finite(name, table),
            DeValue::Array(values) => {
                values.iter().try_for_each(|value| self.check_finite_value(name, value))
            }
            DeValue::Float(number) if !is_finite(number.as_str()) => {
                let problem = Problem::NotFinite(format!("{name} = {}", number.as_str()));
                Err(self.problem_at(problem, value.span()))
            }
            _ => Ok(()),
        }
    }
}

fn is_finite(number: &str) -> bool {
    number.replace('_', "").parse::<f64>().is_ok_and(f64::is_finite)
}

/// A whole number in any base.
pub(super) fn whole(number: &DeInteger) -> Option<i64> {
    i64::from_str_radix(number.as_str(), number.radix()).ok()
}

/// The table of a name, or all tables of an array of tables.
fn tables<'a, 'i>(document: &'a DeTable<'i>, name: &str) -> Vec<&'a Spanned<DeValue<'i>>> {
    match document.get(name).map(|value| (value, value.get_ref())) {
        Some((_, DeValue::Array(tables))) => tables.iter().collect(),
        Some((table, _)) => vec![table],
        None => Vec::new(),
    }
}

fn joint_of(table: &DeValue) -> Option<i64> {
    table.as_table()?.get("joint")?.get_ref().as_integer().and_then(whole)
}
