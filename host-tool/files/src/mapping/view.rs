//! What a mapping says of one log.

use std::collections::{BTreeMap, BTreeSet};

use super::spec::{ColumnSource, LogMapping, Mapping, StreamSource};
use crate::foreign::base_name;
use crate::quantity::Quantity;

/// A log's columns, streams and rows: its own before those of all logs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct View {
    pub(super) columns: BTreeMap<String, ColumnSource>,
    pub(super) streams: BTreeMap<String, StreamSource>,
    pub(super) files: BTreeMap<String, String>,
    pub(super) rows: BTreeMap<String, f64>,
    pub(super) joints: Option<Vec<usize>>,
}

/// The name of the stream whose clock is the log's.
pub(super) const OWN: &str = "log";

impl Mapping {
    /// What it says of the log of that place in the list.
    pub fn view(&self, index: usize) -> View {
        let mut view = View::default();
        for mapping in [Some(&self.common), self.logs.get(index)].into_iter().flatten() {
            view.take(mapping);
        }
        view
    }
}

impl View {
    fn take(&mut self, mapping: &LogMapping) {
        let clone = |(name, source): (&String, &_)| (name.clone(), Clone::clone(source));
        self.columns.extend(mapping.columns.iter().map(clone));
        self.streams
            .extend(mapping.streams.iter().map(|(name, stream)| (name.clone(), stream.clone())));
        self.files.extend(mapping.files.iter().map(|(name, file)| (name.clone(), file.clone())));
        self.joints = mapping.joints.clone().or(self.joints.take());
        self.rows.extend(mapping.rows.iter().map(|(name, value)| (name.clone(), *value)));
    }

    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// The name of a log in messages and reports: its file, and which of its rows.
    pub fn label(&self, file: &str) -> String {
        let rows = self.rows.iter().map(|(name, value)| format!("{name} {value}"));
        match rows.collect::<Vec<_>>().join(", ") {
            rows if rows.is_empty() => file.to_owned(),
            rows => format!("{file} ({rows})"),
        }
    }

    /// Whether a joint of the files is meant; 0 stands for what belongs to no joint.
    pub(super) fn has_joint(&self, joint: usize) -> bool {
        joint == 0 || self.joints.as_ref().is_none_or(|joints| joints.contains(&joint))
    }

    /// Whether a column of a file may be needed, its brackets left away.
    pub(super) fn wants(&self, column: &str) -> bool {
        self.sources().any(|source| base_name(source) == column || source == column)
            || Quantity::of(column).is_some()
            || [crate::foreign::STAMP, crate::foreign::LOG_TIME].contains(&column)
    }

    fn sources(&self) -> impl Iterator<Item = &str> {
        let streams = self.streams.values().filter_map(|stream| stream.time.as_ref());
        let sources = self.columns.values().chain(streams);
        let names = sources.flat_map(|source| [Some(&source.column), source.copy.as_ref()]);
        names.flatten().chain(self.rows.keys()).map(String::as_str)
    }

    /// The streams beside the log's own that its columns come from.
    pub(super) fn other_streams(&self) -> BTreeSet<&str> {
        let names = self.columns.values().map(|source| source.stream.as_str());
        names.filter(|name| !name.is_empty()).collect()
    }

    /// What is said of a stream.
    pub(super) fn stream(&self, name: &str) -> StreamSource {
        self.streams.get(name).cloned().unwrap_or_default()
    }
}
