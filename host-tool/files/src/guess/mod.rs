//! What the columns of a foreign file may be, by their names and values. Every guess has its reason.

mod columns;
mod joints;
mod look;
mod roles;
mod units;
mod words;

pub use columns::{Command, Looked, UNNAMED, guess};
pub use look::look;

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
}

impl Guess {
    /// The line of `[columns]` that says so; `stream` where it is not the log's own.
    pub fn line(&self, stream: &str) -> String {
        let name = self.quantity.name();
        let column = toml::Value::from(self.column.as_str());
        let mut keys = match stream {
            "" => String::new(),
            stream => format!("stream = {}, ", toml::Value::from(stream)),
        };
        keys += &format!("column = {column}");
        if !self.is_in_si() {
            keys += &format!(", unit = \"{}\"", self.unit);
        }
        match keys.starts_with("column") && self.is_in_si() {
            true => format!("{name} = {column}"),
            false => format!("{name} = {{ {keys} }}"),
        }
    }

    fn is_in_si(&self) -> bool {
        self.quantity.units().first().is_some_and(|(unit, _)| *unit == self.unit)
    }
}
