//! A table that grows by messages, whose names need not come in the same order, or all of them.

use std::collections::HashMap;

use crate::error::Problem;
use crate::table::{Table, Values};

/// Names that messages may bring at most.
const MOST_NAMES: usize = 4096;

/// Columns by name, as long as the messages so far; what a message lacks is no number.
#[derive(Default)]
pub(super) struct Rows {
    places: HashMap<String, usize>,
    names: Vec<String>,
    columns: Vec<Vec<f64>>,
    rows: usize,
}

impl Rows {
    /// Begins the next message's row.
    pub(super) fn begin(&mut self) {
        self.rows += 1;
    }

    /// How many rows have begun.
    pub(super) fn len(&self) -> usize {
        self.rows
    }

    /// A value of the row that was begun last.
    pub(super) fn set(&mut self, name: &str, value: f64) {
        let place = match self.places.get(name) {
            Some(&place) => place,
            None if self.names.len() < MOST_NAMES => self.add(name),
            None => return,
        };
        let column = &mut self.columns[place];
        column.resize(self.rows.saturating_sub(1), f64::NAN);
        column.push(value);
    }

    fn add(&mut self, name: &str) -> usize {
        let place = self.names.len();
        self.places.insert(name.to_owned(), place);
        self.names.push(name.to_owned());
        self.columns.push(Vec::new());
        place
    }

    /// The table, with columns before those of the messages.
    pub(super) fn table(self, mut first: Vec<(String, Values)>) -> Result<Table, Problem> {
        for (name, mut values) in self.names.into_iter().zip(self.columns) {
            values.resize(self.rows, f64::NAN);
            first.push((name, Values::Float(values)));
        }
        Table::of(first)
    }
}
