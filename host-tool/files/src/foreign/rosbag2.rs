//! Recordings of ROS 2: rosbag2's MCAP, with messages in CDR.

use std::collections::BTreeMap;

use super::ros_message::{Decoded, decode, is_known};
use super::rows::Rows;
use super::{Stream, Wanted, base_name};
use crate::error::Problem;
use crate::mcap_records::{TopicMessage, for_each_message};
use crate::table::Values;

/// The column of times in the messages' headers [ns].
pub const STAMP: &str = "header.stamp";
/// The column of times at which messages were recorded [ns].
pub const LOG_TIME: &str = "log_time";

/// A stream for each topic whose messages are read.
pub(super) fn read(bytes: &[u8], wanted: Wanted) -> Result<Vec<Stream>, Problem> {
    let mut topics: BTreeMap<String, Topic> = BTreeMap::new();
    let mut others = BTreeMap::new();
    for_each_message(bytes, |message| {
        if message.encoding == "cdr" && is_known(message.schema) {
            let topic = topics.entry(message.topic.to_owned()).or_default();
            return topic.push(&message, wanted);
        }
        let what = || format!("{} ({}, {})", message.topic, message.schema, message.encoding);
        others.entry(message.topic.to_owned()).or_insert_with(what);
        Ok(())
    })?;
    if topics.is_empty() {
        let others: Vec<String> = others.into_values().collect();
        return Err(Problem::NoTopic(others.join(", ")));
    }
    topics.into_iter().map(|(name, topic)| topic.stream(name)).collect()
}

#[derive(Default)]
struct Topic {
    stamps_ns: Vec<i64>,
    log_times_ns: Vec<i64>,
    rows: Rows,
}

impl Topic {
    fn push(&mut self, message: &TopicMessage<'_>, wanted: Wanted) -> Result<(), Problem> {
        let decoded = decode(message.schema, message.data);
        let Decoded { stamp_ns, values } = decoded.map_err(|what| Problem::BrokenMessage {
            topic: message.topic.to_owned(),
            number: self.rows.len() + 1,
            what: format!("({}) {what}", message.schema),
        })?;
        self.rows.begin();
        self.stamps_ns.extend(stamp_ns);
        self.log_times_ns.push(i64::try_from(message.log_time_ns).unwrap_or(i64::MAX));
        let values = values.iter().filter(|(name, _)| wanted(base_name(name)));
        values.for_each(|(name, value)| self.rows.set(name, *value));
        Ok(())
    }

    /// The topic's columns; headers that were never stamped are left out.
    fn stream(self, name: String) -> Result<Stream, Problem> {
        let mut times = Vec::new();
        if self.stamps_ns.len() == self.rows.len() && self.stamps_ns.iter().any(|ns| *ns != 0) {
            times.push((STAMP.to_owned(), Values::Count(self.stamps_ns)));
        }
        times.push((LOG_TIME.to_owned(), Values::Count(self.log_times_ns)));
        Ok(Stream { name, table: self.rows.table(times)? })
    }
}
