//! What was seen of a column.

use super::words::words;
use crate::foreign::{LOG_TIME, STAMP};

/// What was seen of a column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Looked {
    /// What the column stands in: a topic, say, whose words count as well.
    pub context: String,
    /// Its name.
    pub name: String,
    /// Largest size of a value.
    pub largest: f64,
    /// Median of the steps from row to row.
    pub median_step: f64,
    /// Whether all values are whole numbers.
    pub is_whole: bool,
}

impl Looked {
    /// The words of its name and of what it stands in.
    pub(super) fn words(&self) -> Vec<String> {
        words(&self.full_name())
    }

    /// Its name behind what it stands in; times of messages say nothing of their topic.
    pub(super) fn full_name(&self) -> String {
        match self.name.as_str() {
            STAMP | LOG_TIME => self.name.clone(),
            name => format!("{} {name}", self.context),
        }
    }
}
