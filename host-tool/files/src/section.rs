//! Tables of a TOML file read value by value, each with its line, so that a key that nobody asked
//! for can be refused.

use std::cell::RefCell;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{FileError, Problem};
use super::known_keys::FOR_PEOPLE;
use super::toml_source::{TomlSource, whole};

/// A table, and the keys that were asked for.
pub(super) struct Section<'a, 'i> {
    source: &'a TomlSource,
    /// What messages call it.
    name: String,
    table: &'a DeTable<'i>,
    span: Range<usize>,
    asked: RefCell<Vec<String>>,
}

impl<'a, 'i> Section<'a, 'i> {
    /// The whole file.
    pub(super) fn of(source: &'a TomlSource, document: &'a Spanned<DeTable<'i>>) -> Self {
        Self::new(source, "the file".to_owned(), document.get_ref(), 0..0)
    }

    fn new(
        source: &'a TomlSource,
        name: String,
        table: &'a DeTable<'i>,
        span: Range<usize>,
    ) -> Self {
        Self { source, name, table, span, asked: RefCell::default() }
    }

    fn get(&self, key: &str) -> Option<&'a Spanned<DeValue<'i>>> {
        self.asked.borrow_mut().push(key.to_owned());
        self.table.get(key)
    }

    /// Whether a key is there.
    pub(super) fn has(&self, key: &str) -> bool {
        self.get(key).is_some()
    }

    /// A number.
    pub(super) fn number(&self, key: &str) -> Result<Option<f64>, FileError> {
        let Some(value) = self.get(key) else { return Ok(None) };
        let wrong = || self.wrong(key, value, "a number");
        number(value.get_ref()).map(Some).ok_or_else(wrong)
    }

    /// As many numbers as a list must have.
    pub(super) fn numbers<const N: usize>(&self, key: &str) -> Result<Option<[f64; N]>, FileError> {
        let Some(value) = self.get(key) else { return Ok(None) };
        let found: Option<Vec<f64>> = match value.get_ref() {
            DeValue::Array(values) => values.iter().map(|v| number(v.get_ref())).collect(),
            _ => None,
        };
        let found = found.and_then(|found| <[f64; N]>::try_from(found).ok());
        found.map(Some).ok_or_else(|| self.wrong(key, value, &format!("a list of {N} numbers")))
    }

    /// Numbers, one or several.
    pub(super) fn list(&self, key: &str) -> Result<Option<Vec<f64>>, FileError> {
        let Some(value) = self.get(key) else { return Ok(None) };
        let found: Option<Vec<f64>> = match value.get_ref() {
            DeValue::Array(values) => values.iter().map(|v| number(v.get_ref())).collect(),
            one => number(one).map(|one| vec![one]),
        };
        found.map(Some).ok_or_else(|| self.wrong(key, value, "a number or a list of numbers"))
    }

    /// A string.
    pub(super) fn text(&self, key: &str) -> Result<Option<String>, FileError> {
        let Some(value) = self.get(key) else { return Ok(None) };
        let text = value.get_ref().as_str().map(str::to_owned);
        text.map(Some).ok_or_else(|| self.wrong(key, value, "a string in quotes"))
    }

    /// One of several words.
    pub(super) fn word<T: Copy>(
        &self,
        key: &str,
        words: &[(&str, T)],
    ) -> Result<Option<T>, FileError> {
        let Some(text) = self.text(key)? else { return Ok(None) };
        let found = words.iter().find(|(word, _)| *word == text).map(|(_, meaning)| *meaning);
        let all: Vec<_> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        let must = || format!("{key} is \"{text}\", but must be one of {}", all.join(", "));
        found.map(Some).ok_or_else(|| self.problem(key, Problem::Toml(must())))
    }

    /// A table below this one; `name` is for messages.
    pub(super) fn section(&self, key: &str, name: &str) -> Result<Option<Self>, FileError> {
        let Some(value) = self.get(key) else { return Ok(None) };
        self.inner(key, value, name.to_owned(), "a table").map(Some)
    }

    /// An array of tables, called by name and number.
    pub(super) fn sections(&self, key: &str) -> Result<Vec<Self>, FileError> {
        let Some(value) = self.get(key) else { return Ok(Vec::new()) };
        let DeValue::Array(values) = value.get_ref() else {
            return Err(self.wrong(key, value, &format!("tables under [[{key}]]")));
        };
        let one =
            |(number, value)| self.inner(key, value, format!("[[{key}]] {number}"), "a table");
        (1..).zip(values.iter()).map(one).collect()
    }

    fn inner(
        &self,
        key: &str,
        value: &'a Spanned<DeValue<'i>>,
        name: String,
        must: &str,
    ) -> Result<Self, FileError> {
        match value.get_ref() {
            DeValue::Table(table) => Ok(Self::new(self.source, name, table, value.span())),
            _ => Err(self.wrong(key, value, must)),
        }
    }

    /// Refuses the first key that was never asked for.
    pub(super) fn finish(self) -> Result<(), FileError> {
        let asked = self.asked.borrow();
        let is_unknown = |key: &&Spanned<_>| {
            !asked.iter().any(|name| name == key_text(key)) && !FOR_PEOPLE.contains(&key_text(key))
        };
        let Some(key) = self.table.keys().find(is_unknown) else { return Ok(()) };
        let mut known: Vec<&str> = Vec::new();
        for name in asked.iter() {
            if !known.contains(&name.as_str()) {
                known.push(name);
            }
        }
        let (key_name, known) = (key_text(key), known.join(", "));
        let what = format!("{key_name} is not known in {}; known are {known}", self.name);
        let problem = Problem::UnknownKey(what);
        Err(self.source.problem_at(problem, key.span()))
    }

    /// A problem at the line of a key, or of the table where it lacks the key.
    pub(super) fn problem(&self, key: &str, problem: Problem) -> FileError {
        let span = self.table.get(key).map_or(self.span.clone(), Spanned::span);
        self.source.problem_at(problem, span)
    }

    /// What messages call the table.
    pub(super) fn name(&self) -> &str {
        &self.name
    }

    fn wrong(&self, key: &str, value: &Spanned<DeValue>, must: &str) -> FileError {
        let problem = Problem::Toml(format!("{key} in {} must be {must}", self.name));
        self.source.problem_at(problem, value.span())
    }
}

fn key_text<'k>(key: &'k Spanned<toml::de::DeString<'_>>) -> &'k str {
    key.get_ref()
}

fn number(value: &DeValue) -> Option<f64> {
    match value {
        DeValue::Integer(integer) => whole(integer).map(|whole| whole as f64),
        DeValue::Float(float) => float.as_str().replace('_', "").parse().ok(),
        _ => None,
    }
}
