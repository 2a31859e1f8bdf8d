//! Every threshold of the diagnosis: what is used, what is tried, what counts.
//!
//! A value whose source is not named was set by judgement; the labelled cases and the blind trial
//! (`docs/blind-trial.md`) test all of them together. "Noise" is the noise of the rows, "squares"
//! are sums of squares of rows in its units.

mod axes;
mod doubt;
mod faults;
mod fit;
mod logs;
mod rows;
mod search;
mod selection;
mod table;
#[cfg(test)]
mod tests;
mod verdict;

use std::path::Path;

use serde::{Deserialize, Serialize};

use files::{FileError, settings};

pub use axes::AxisCriteria;
pub use doubt::Doubt;
pub use faults::FaultCriteria;
pub use fit::{FitCriteria, PriorCriteria};
pub use logs::LogCriteria;
pub use rows::RowCriteria;
pub use search::SearchCriteria;
pub use selection::SelectionCriteria;
pub use verdict::VerdictCriteria;

/// The thresholds, stage by stage.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Criteria {
    /// Which logs are used, and how their motion is smoothed.
    pub logs: LogCriteria,
    /// Rows and the noise in them.
    pub rows: RowCriteria,
    /// What is known of the model beforehand.
    pub prior: PriorCriteria,
    /// Fits, and how they are judged.
    pub fit: FitCriteria,
    /// How candidates are found.
    pub search: SearchCriteria,
    /// Which of them are added to the model.
    pub selection: SelectionCriteria,
    /// What the search amounts to.
    pub verdict: VerdictCriteria,
    /// Faults of the model as given.
    pub faults: FaultCriteria,
    /// What the gap varies with.
    pub axes: AxisCriteria,
}

impl Criteria {
    /// Reads a TOML file; what it does not name keeps its default.
    ///
    /// # Errors
    /// Names the file and line, what is wrong, and the cure: an unknown key, say, or a number that
    /// is not positive.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, FileError> {
        settings::read(path.as_ref(), Self::out_of_range)
    }

    /// All criteria as TOML, each below its meaning.
    pub fn to_toml(&self) -> String {
        let sections = [
            ("logs", self.logs.commented()),
            ("rows", self.rows.commented()),
            ("prior", self.prior.commented()),
            ("fit", self.fit.commented()),
            ("search", self.search.commented()),
            ("selection", self.selection.commented()),
            ("verdict", self.verdict.commented()),
            ("faults", self.faults.commented()),
            ("axes", self.axes.commented()),
        ];
        sections.map(|(name, lines)| format!("[{name}]\n{lines}")).join("\n")
    }

    /// The first value that no diagnosis can be made with, with its table and key.
    fn out_of_range(&self) -> Option<settings::OutOfRange> {
        let parts = [
            ("logs", "held_out_part", self.logs.held_out_part, 1.0),
            ("logs", "fast_part", self.logs.fast_part, 0.5),
            ("rows", "cutoff_part", self.rows.cutoff_part, 0.5),
            ("rows", "highest_noise_part", self.rows.highest_noise_part, 0.5),
            ("rows", "highest_corner_part", self.rows.highest_corner_part, 0.5),
        ];
        let too_large = parts.into_iter().find(|(_, _, value, below)| value >= below);
        let too_large = too_large.map(|(table, key, value, below)| settings::OutOfRange {
            table: table.into(),
            key: key.into(),
            what: format!("{value} is not below {below}"),
        });
        too_large.or_else(|| settings::not_positive(self))
    }
}
