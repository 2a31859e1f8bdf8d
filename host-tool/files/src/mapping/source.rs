//! A stream of the mapping, and the columns of a log that come from it.

use super::assemble::Wanted;
use super::clock::Origin;
use super::lane::{Lane, Times};
use super::spec::{ColumnSource, StreamSource};
use super::view::{OWN, View};
use crate::error::LocatedProblem;
use crate::foreign::{LOG_TIME, STAMP, Stream};
use crate::quantity::{Quantity, Role};
use crate::table::Values;

/// A stream of the mapping, as it was read.
pub(super) struct Source {
    pub(super) name: String,
    pub(super) file: String,
    pub(super) said: StreamSource,
    pub(super) stream: Stream,
}

impl Source {
    fn has(&self, column: &str) -> bool {
        self.stream.table.get(column).is_some()
    }

    /// The columns that come from this stream; those that are called as in a log need no mapping.
    pub(super) fn wanted(&self, view: &View, missing: &mut Vec<String>) -> Vec<Wanted> {
        let is_own = self.name == OWN;
        let mut wanted = Vec::new();
        for (name, source) in view.columns.iter().filter(|(name, _)| *name != "t_s") {
            let is_here =
                if is_own { source.stream.is_empty() } else { source.stream == self.name };
            let is_meant = |quantity: &Quantity| is_here && view.has_joint(quantity.joint);
            let Some(quantity) = Quantity::of(name).filter(is_meant) else { continue };
            if self.has(&source.column) {
                wanted.push(Wanted { quantity, source: source.clone() });
            } else if !self.has(name) {
                missing.push(format!("{} (for {name})", source.column));
            }
        }
        if is_own {
            let is_mapped = |new: &Wanted| {
                wanted.iter().any(|old| same_place(old.quantity, new.quantity))
                    || view.columns.iter().any(|(name, source)| {
                        !source.stream.is_empty()
                            && Quantity::of(name).is_some_and(|old| same_place(old, new.quantity))
                    })
            };
            let named = self.stream.table.names().filter(|name| *name != "t_s" && self.has(name));
            let is_meant = |new: &Wanted| view.has_joint(new.quantity.joint) && !is_mapped(new);
            let named: Vec<Wanted> = named.filter_map(Wanted::as_named).filter(is_meant).collect();
            wanted.extend(named);
        }
        wanted
    }

    /// Which column tells the time.
    pub(super) fn times(&self, view: &View, missing: &mut Vec<String>) -> Option<Times> {
        let of_log = view.columns.get("t_s");
        let said = self.said.time.as_ref().or(of_log);
        let plain = ["t_s", STAMP, LOG_TIME].map(ColumnSource::named);
        let sources = said.into_iter().chain(&plain);
        let times = sources.filter(|source| self.has(&source.column)).map(Times::of).next();
        if times.is_none() {
            missing.push(match (said, self.name.as_str()) {
                (Some(said), _) => format!("{} (for the time)", said.column),
                (None, OWN) => "t_s".to_owned(),
                (None, name) => format!("t_s (or time in [streams.{name}])"),
            });
        }
        times
    }

    /// The rows that can be used.
    pub(super) fn lane(
        &self,
        times: &Times,
        wanted: &[Wanted],
        origin: Origin,
        view: &View,
    ) -> Result<Lane, LocatedProblem> {
        let table = &self.stream.table;
        let columns: Vec<&Values> =
            wanted.iter().filter_map(|wanted| table.get(&wanted.source.column)).collect();
        Lane::of(table, times, origin, &columns, &view.rows)
    }

    /// A column in the log's unit.
    pub(super) fn values(&self, wanted: &Wanted, lane: &Lane) -> Vec<f64> {
        let column = self.stream.table.get(&wanted.source.column);
        column.map_or_else(Vec::new, |column| wanted.values(column, lane))
    }
}

/// Whether two columns say the same of a joint.
fn same_place(a: Quantity, b: Quantity) -> bool {
    let role = |quantity: Quantity| match quantity.role {
        Role::Count => Role::Position,
        role => role,
    };
    role(a) == role(b) && a.joint == b.joint
}
