//! What `dataset.toml` says of foreign columns.

use std::collections::BTreeMap;
use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};

/// The mapping of a data set, and what single logs have of their own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mapping {
    /// For all logs.
    pub common: LogMapping,
    /// For each `[[log]]`, in their order.
    pub logs: Vec<LogMapping>,
}

/// Columns and streams, of all logs or of one.
#[derive(Clone, Debug, Default, PartialEq, serde::Deserialize)]
pub struct LogMapping {
    /// Sources by the names of a log's columns.
    #[serde(default)]
    pub columns: BTreeMap<String, ColumnSource>,
    /// Streams by name; `log` is the one whose clock is the log's.
    #[serde(default)]
    pub streams: BTreeMap<String, StreamSource>,
    /// Files of streams by name.
    #[serde(default)]
    pub files: BTreeMap<String, String>,
    /// Only rows in which these columns have these values.
    #[serde(default)]
    pub rows: BTreeMap<String, f64>,
    /// Only these joints of the files, where not all are meant.
    pub joints: Option<Vec<usize>>,
}

/// Where a column of a log comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnSource {
    /// Stream; empty for the log's own.
    pub stream: String,
    /// Name in the file, or of an element of a list: `state[0]`.
    pub column: String,
    /// Unit in the file; absent for that of the log's column.
    pub unit: Option<String>,
    /// Factor after the unit; -1 for the other sign.
    pub scale: f64,
    /// What is added after that, in the log's unit.
    pub offset: f64,
    /// Column of the log's own stream that shows the same signal, by which a lag is found.
    pub copy: Option<String>,
    /// Whether the values lack their sign.
    pub unsigned: bool,
    /// Step of values that are coarse, in the log's unit.
    pub step: Option<f64>,
    /// Turn after which values begin anew, in the log's unit: 2 pi, say.
    pub wraps_at: Option<f64>,
}

impl Default for ColumnSource {
    fn default() -> Self {
        Table::default().source()
    }
}

impl ColumnSource {
    /// A column that is as it should be.
    pub fn named(column: &str) -> Self {
        Self { column: column.to_owned(), ..Self::default() }
    }
}

/// A stream of rows with a clock.
#[derive(Clone, Debug, Default, PartialEq, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StreamSource {
    /// File, where it is not the log's; a log's `files` goes before it.
    pub file: Option<String>,
    /// Topic of a recording of ROS.
    pub topic: Option<String>,
    /// Its times; absent where they are named as those of the log's stream.
    pub time: Option<ColumnSource>,
    /// Whether its clock is the log's.
    #[serde(default)]
    pub clock: Clock,
    /// Time added to its times [s].
    #[serde(default)]
    pub shift_s: f64,
}

/// How a stream's clock goes with that of the log.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Clock {
    /// They are the same.
    #[default]
    Same,
    /// It has its own zero, found by a copy of a signal.
    Own,
}

/// A source written as a table.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    #[serde(default)]
    stream: String,
    column: String,
    unit: Option<String>,
    #[serde(default = "one")]
    scale: f64,
    #[serde(default)]
    offset: f64,
    copy: Option<String>,
    #[serde(default)]
    unsigned: bool,
    step: Option<f64>,
    wraps_at: Option<f64>,
}

fn one() -> f64 {
    1.0
}

impl Default for Table {
    fn default() -> Self {
        Self {
            stream: String::new(),
            column: String::new(),
            unit: None,
            scale: 1.0,
            offset: 0.0,
            copy: None,
            unsigned: false,
            step: None,
            wraps_at: None,
        }
    }
}

impl Table {
    fn source(self) -> ColumnSource {
        let Self { stream, column, unit, scale, offset, copy, unsigned, step, wraps_at } = self;
        let stream = if stream == "log" { String::new() } else { stream };
        ColumnSource { stream, column, unit, scale, offset, copy, unsigned, step, wraps_at }
    }
}

impl<'de> Deserialize<'de> for ColumnSource {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NameOrTable)
    }
}

/// A column's name alone, or a table with more.
struct NameOrTable;

impl<'de> Visitor<'de> for NameOrTable {
    type Value = ColumnSource;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "the name of a column, or {{ column = \"..\", unit = \"..\" }}")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<ColumnSource, E> {
        Ok(ColumnSource::named(name))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<ColumnSource, A::Error> {
        Table::deserialize(MapAccessDeserializer::new(map)).map(Table::source)
    }
}
