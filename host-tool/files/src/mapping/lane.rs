//! The rows of a stream that can be used: all numbers there, times increasing.

use std::collections::BTreeMap;

use super::clock::Origin;
use super::spec::ColumnSource;
use crate::error::{LocatedProblem, Place, Problem};
use crate::foreign::LOG_TIME;
use crate::quantity::{Factor, Quantity};
use crate::table::{Table, Values};

/// The times of a stream: its column and unit.
#[derive(Clone, Debug)]
pub(super) struct Times {
    pub(super) source: ColumnSource,
    pub(super) unit: Factor,
}

/// Rows of a stream and their times.
#[derive(Debug)]
pub(super) struct Lane {
    pub(super) time_s: Vec<f64>,
    /// Which rows of the stream.
    pub(super) rows: Vec<usize>,
    /// What was left out.
    pub(super) notes: Vec<String>,
}

impl Times {
    /// Those that a source names.
    pub(super) fn of(source: &ColumnSource) -> Self {
        // Recordings of ROS keep nanoseconds.
        let default = match source.column.as_str() {
            LOG_TIME | crate::foreign::STAMP => "ns",
            _ => "s",
        };
        let unit = Quantity::TIME.factor(source.unit.as_deref().unwrap_or(default));
        Self { source: source.clone(), unit: unit.unwrap_or(Factor::Times(1.0)) }
    }

    /// The origin of a stream's times.
    pub(super) fn origin(&self, table: &Table) -> Origin {
        table
            .get(&self.source.column)
            .map_or(Origin::Seconds(0.0), |values| Origin::of(values, self.unit))
    }

    fn seconds(&self, table: &Table, origin: Origin) -> Vec<f64> {
        let values = table.get(&self.source.column);
        let mut seconds = values.map_or_else(Vec::new, |values| origin.seconds(values, self.unit));
        let ColumnSource { scale, offset, .. } = self.source;
        if (scale, offset) != (1.0, 0.0) {
            seconds.iter_mut().for_each(|time_s| *time_s = *time_s * scale + offset);
        }
        seconds
    }
}

impl Lane {
    /// The rows with these values in `wanted`, in which the columns are numbers, in the order of time.
    pub(super) fn of(
        table: &Table,
        times: &Times,
        origin: Origin,
        columns: &[&Values],
        wanted: &BTreeMap<String, f64>,
    ) -> Result<Self, LocatedProblem> {
        let time_s = times.seconds(table, origin);
        let filters: Vec<_> =
            wanted.iter().filter_map(|(name, value)| Some((table.get(name)?, *value))).collect();
        let is_wanted =
            |row: &usize| filters.iter().all(|(values, value)| values.at(*row) == *value);
        let mut rows: Vec<usize> = (0..table.rows()).filter(is_wanted).collect();
        let (selected, mut notes) = (rows.len(), Vec::new());
        let is_number = |row: &usize| {
            time_s[*row].is_finite() && columns.iter().all(|values| values.at(*row).is_finite())
        };
        rows.retain(is_number);
        told(&mut notes, selected - rows.len(), "rows that lack a number were left out");
        // Messages are recorded as they arrive, which need not be the order of their stamps.
        if times.source.column == crate::foreign::STAMP {
            rows.sort_by(|a, b| time_s[*a].total_cmp(&time_s[*b]));
        }
        let whole = rows.len();
        rows.dedup_by(|now, before| time_s[*now] == time_s[*before]);
        told(&mut notes, whole - rows.len(), "rows that repeat the time before them were left out");
        let lane = Self { time_s: rows.iter().map(|row| time_s[*row]).collect(), rows, notes };
        lane.check(selected, &times.source.column)?;
        Ok(lane)
    }

    fn check(&self, selected: usize, column: &str) -> Result<(), LocatedProblem> {
        if selected == 0 {
            return Err(Problem::NoSamples.into());
        }
        if self.rows.is_empty() {
            let what = "no row has a number in all columns that are needed".to_owned();
            return Err(Problem::Contradiction(what).into());
        }
        match self.time_s.windows(2).find(|pair| pair[1] < pair[0]) {
            Some(pair) => Err(Problem::TimeNotIncreasing { before_s: pair[0], now_s: pair[1] }
                .at(Place::column(column))),
            None => Ok(()),
        }
    }

    /// A column's values in these rows.
    pub(super) fn values(&self, column: &Values) -> Vec<f64> {
        self.rows.iter().map(|row| column.at(*row)).collect()
    }

    /// The usual time from row to row [s]: the median.
    pub(super) fn period_s(&self) -> f64 {
        let mut steps: Vec<f64> = self.time_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
        if steps.is_empty() {
            return 0.0;
        }
        let middle = steps.len() / 2;
        *steps.select_nth_unstable_by(middle, f64::total_cmp).1
    }
}

fn told(notes: &mut Vec<String>, count: usize, what: &str) {
    if count > 0 {
        notes.push(format!("{what}: {count}"));
    }
}
