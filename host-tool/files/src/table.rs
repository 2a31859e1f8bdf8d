//! Comma-separated numbers under a header line, read fast.
//!
//! A log of eight minutes has six million numbers, so lines are not split into fields
//! first: each number is parsed where it stands, and only a line that does not parse
//! that way is looked at again, to accept blanks and quotes or to say what is wrong.

use std::path::Path;

use super::error::{FileError, LocatedProblem, Place, Problem};
use super::{bytes, number};

/// How a column is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Not at all.
    Skipped,
    /// As finite numbers.
    Float,
    /// As whole numbers.
    Count,
}

/// A table's columns, without those that were skipped.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    columns: Vec<(String, Values)>,
    rows: usize,
}

/// The values of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// None: the column was skipped.
    Skipped,
    /// Finite numbers.
    Float(Vec<f64>),
    /// Whole numbers.
    Count(Vec<i64>),
}

impl Table {
    /// Reads a `.csv` or `.csv.gz` file; `kind_of` chooses by name what is read of it.
    ///
    /// # Errors
    /// Names the file, line and column, and what is wrong.
    pub fn read(path: &Path, kind_of: impl Fn(&str) -> Kind) -> Result<Self, FileError> {
        let text = bytes::read(path)?;
        Self::parse(&text, kind_of).map_err(|fault| fault.in_file(path))
    }

    /// Parses a table's text.
    ///
    /// # Errors
    /// Names the line and column, and what is wrong.
    pub fn parse(text: &[u8], kind_of: impl Fn(&str) -> Kind) -> Result<Self, LocatedProblem> {
        bytes::check_text(text)?;
        let text = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text).trim_ascii_end();
        let (header, lines) = split_line(text);
        let mut table = Self::with_header(header, kind_of)?;
        table.reserve(lines, header.len());
        table.push_lines(lines)?;
        Ok(table)
    }

    /// A table of columns by name, all of the same length but for those that are skipped.
    ///
    /// # Errors
    /// Columns that differ in length.
    pub fn of(columns: Vec<(String, Values)>) -> Result<Self, Problem> {
        let mut lengths = columns.iter().filter_map(|(_, values)| values.rows());
        let rows = lengths.next().unwrap_or(0);
        match lengths.find(|length| *length != rows) {
            Some(found) => Err(Problem::UnequalLength { found, expected: rows }),
            None => Ok(Self { columns, rows }),
        }
    }

    /// A column, unless it is skipped or not there.
    pub fn get(&self, name: &str) -> Option<&Values> {
        let (_, values) = self.columns.iter().find(|(other, _)| other == name)?;
        Some(values).filter(|values| **values != Values::Skipped)
    }

    fn with_header(header: &[u8], kind_of: impl Fn(&str) -> Kind) -> Result<Self, LocatedProblem> {
        if header.trim_ascii().is_empty() {
            return Err(Problem::Empty.into());
        }
        let mut columns: Vec<(String, Values)> = Vec::new();
        for field in header.split(|&byte| byte == b',') {
            let name = String::from_utf8_lossy(number::trim(field)).into_owned();
            let values = Values::empty(kind_of(&name));
            if values != Values::Skipped && columns.iter().any(|(other, _)| *other == name) {
                return Err(Problem::RepeatedColumn.at(Place::line(1).and_column(name)));
            }
            columns.push((name, values));
        }
        Ok(Self { columns, rows: 0 })
    }

    /// Makes room for as many rows as the first line's length lets expect.
    fn reserve(&mut self, lines: &[u8], header_length: usize) {
        let first = split_line(lines).0.len().max(header_length / 2).max(8);
        for (_, values) in &mut self.columns {
            values.reserve(lines.len() / first);
        }
    }

    fn push_lines(&mut self, mut lines: &[u8]) -> Result<(), LocatedProblem> {
        while !lines.is_empty() {
            lines = match self.push_plain_line(lines) {
                Some(rest) => rest,
                None => {
                    let (line, rest) = split_line(lines);
                    self.push_odd_line(line)?;
                    rest
                }
            };
            self.rows += 1;
        }
        Ok(())
    }

    /// Takes in a line of bare numbers and returns what follows it, or `None`, with
    /// some columns one value ahead, where the line is anything else.
    #[inline]
    fn push_plain_line<'a>(&mut self, mut text: &'a [u8]) -> Option<&'a [u8]> {
        let last = self.columns.len() - 1;
        for (index, (_, values)) in self.columns.iter_mut().enumerate() {
            let length = values.push_prefix(text)?;
            let end = if index == last { b'\n' } else { b',' };
            text = match text.get(length) {
                Some(&byte) if byte == end => &text[length + 1..],
                Some(b'\r') if index == last && text.get(length + 1) == Some(&b'\n') => {
                    &text[length + 2..]
                }
                None if index == last => &[],
                _ => return None,
            };
        }
        Some(text)
    }

    /// Takes in a line field by field, or says what is wrong with it.
    fn push_odd_line(&mut self, line: &[u8]) -> Result<(), LocatedProblem> {
        let place = Place::line(self.rows + 2);
        let expected = self.columns.len();
        let found = line.split(|&byte| byte == b',').count();
        if found != expected {
            return Err(Problem::FieldCount { found, expected }.at(place));
        }
        let fields = line.split(|&byte| byte == b',');
        for ((name, values), field) in self.columns.iter_mut().zip(fields) {
            values.truncate(self.rows);
            values.push(field).map_err(|problem| problem.at(place.clone().and_column(&*name)))?;
        }
        Ok(())
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The names of the header, of skipped columns as well.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|(name, _)| name.as_str())
    }

    /// Takes a column out.
    pub fn take(&mut self, name: &str) -> Option<Values> {
        let index = self.columns.iter().position(|(other, _)| other == name)?;
        Some(std::mem::replace(&mut self.columns[index].1, Values::Skipped))
    }

    /// Takes a column of numbers out.
    ///
    /// # Errors
    /// The column is missing.
    pub fn take_float(&mut self, name: &str) -> Result<Vec<f64>, Problem> {
        match self.take(name) {
            Some(Values::Float(values)) => Ok(values),
            _ => Err(Problem::MissingColumn(name.to_owned())),
        }
    }
}

impl Values {
    fn empty(kind: Kind) -> Self {
        match kind {
            Kind::Skipped => Self::Skipped,
            Kind::Float => Self::Float(Vec::new()),
            Kind::Count => Self::Count(Vec::new()),
        }
    }

    /// How many values there are; `None` of a column that is skipped.
    pub fn rows(&self) -> Option<usize> {
        match self {
            Self::Skipped => None,
            Self::Float(values) => Some(values.len()),
            Self::Count(values) => Some(values.len()),
        }
    }

    /// The value of a row; not a number where the column is skipped.
    ///
    /// # Panics
    /// The column has no such row.
    pub fn at(&self, row: usize) -> f64 {
        match self {
            Self::Skipped => f64::NAN,
            Self::Float(values) => values[row],
            Self::Count(values) => values[row] as f64,
        }
    }

    fn reserve(&mut self, rows: usize) {
        match self {
            Self::Skipped => {}
            Self::Float(values) => values.reserve(rows),
            Self::Count(values) => values.reserve(rows),
        }
    }

    fn truncate(&mut self, rows: usize) {
        match self {
            Self::Skipped => {}
            Self::Float(values) => values.truncate(rows),
            Self::Count(values) => values.truncate(rows),
        }
    }

    /// Takes in the bare number that `text` begins with and returns its length.
    #[inline]
    fn push_prefix(&mut self, text: &[u8]) -> Option<usize> {
        match self {
            Self::Skipped => Some(memchr::memchr2(b',', b'\n', text).unwrap_or(text.len())),
            Self::Float(values) => {
                let (value, length) = number::float_prefix(text)?;
                values.push(value);
                Some(length)
            }
            Self::Count(values) => {
                let (value, length) = number::count_prefix(text)?;
                values.push(value);
                Some(length)
            }
        }
    }

    fn push(&mut self, field: &[u8]) -> Result<(), Problem> {
        match self {
            Self::Skipped => {}
            Self::Float(values) => values.push(number::float(field)?),
            Self::Count(values) => values.push(number::count(field)?),
        }
        Ok(())
    }
}

/// The first line, without its end, and what follows.
fn split_line(text: &[u8]) -> (&[u8], &[u8]) {
    match memchr::memchr(b'\n', text) {
        Some(end) => (&text[..end], &text[end + 1..]),
        None => (text, &[]),
    }
}
