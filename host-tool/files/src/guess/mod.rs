//! What the columns of a foreign file may be, by their names and values. Every guess has its reason.

mod columns;
mod joints;
mod look;
mod looked;
mod roles;
mod units;
mod words;

pub use columns::{Command, UNNAMED, guess};
pub use look::{look, names_alone};
pub use looked::Looked;

use crate::quantity::Quantity;

/// A column that may be one of a log's.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess {
    /// What it would be.
    pub quantity: Quantity,
    /// Its name in the file.
    pub column: String,
    /// The unit that it is in.
    pub unit: &'static str,
    /// Why, in a few words.
    pub reason: String,
    /// Column of the log's own rows that may show the same signal.
    pub copy: Option<String>,
}

impl Guess {
    /// The line of `[columns]` that says so; `stream` where it is not the log's own.
    pub fn line(&self, stream: &str) -> String {
        let quoted = |text: &str| toml::Value::from(text).to_string();
        let (name, column) = (self.quantity.name(), quoted(&self.column));
        let mut keys = Vec::new();
        if !stream.is_empty() {
            keys.push(format!("stream = {}", quoted(stream)));
        }
        keys.push(format!("column = {column}"));
        if !self.is_in_si() {
            keys.push(format!("unit = \"{}\"", self.unit));
        }
        keys.extend(self.copy.iter().map(|copy| format!("copy = {}", quoted(copy))));
        match keys.len() {
            1 => format!("{name} = {column}"),
            _ => format!("{name} = {{ {} }}", keys.join(", ")),
        }
    }

    fn is_in_si(&self) -> bool {
        self.quantity.units().first().is_some_and(|(unit, _)| *unit == self.unit)
    }
}
