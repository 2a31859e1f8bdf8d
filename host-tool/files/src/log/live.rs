//! The messages of a log that grows.

use std::ops::Range;

use serde::Serialize;

use super::channel::Channel;
use super::joint_columns::JointColumns;
use super::{JointLog, Log, Position};

/// A message, as JSON.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// Which channel of [`channels`].
    pub channel: usize,
    /// Time of the row [s].
    pub t_s: f64,
    /// The JSON.
    pub json: Vec<u8>,
}

/// The channels of a log's joints; of a log without rows none.
pub fn channels(log: &Log, counts_per_rev: Option<f64>) -> Vec<Channel> {
    let first = part(log, 0..log.len().min(1));
    let joints = if first.is_empty() { &[][..] } else { &first.joints };
    let of_joint = |joint: &JointLog| {
        JointColumns::of(joint, &first.time_s, counts_per_rev).channels(first.time_s[0])
    };
    joints.iter().flat_map(of_joint).collect()
}

/// The messages of some of a log's rows; the velocity of the last row is that since the one before.
pub fn messages(log: &Log, rows: Range<usize>, counts_per_rev: Option<f64>) -> Vec<Message> {
    let before = rows.start.saturating_sub(1);
    let part = part(log, before..rows.end);
    let mut messages = Vec::new();
    let mut channel = 0;
    for joint in &part.joints {
        let columns = JointColumns::of(joint, &part.time_s, counts_per_rev);
        for row in rows.start - before..part.len() {
            let t_s = part.time_s[row];
            messages.push(message(channel, t_s, &columns.message(row, t_s)));
            let count = columns.count_message(row, t_s);
            messages.extend(count.map(|count| message(channel + 1, t_s, &count)));
        }
        channel += 1 + usize::from(columns.has_count_channel());
    }
    messages.sort_by(|a, b| a.t_s.total_cmp(&b.t_s));
    messages
}

fn message(channel: usize, t_s: f64, message: &impl Serialize) -> Message {
    Message { channel, t_s, json: serde_json::to_vec(message).unwrap_or_default() }
}

/// Some rows of a log.
fn part(log: &Log, rows: Range<usize>) -> Log {
    let joints = log.joints.iter().map(|joint| JointLog {
        joint: joint.joint,
        position: match &joint.position {
            Position::Count(counts) => Position::Count(counts[rows.clone()].to_vec()),
            Position::Radian(angles) => Position::Radian(angles[rows.clone()].to_vec()),
        },
        command_v: joint.command_v[rows.clone()].to_vec(),
        reference_rad: joint.reference_rad.as_ref().map(|values| values[rows.clone()].to_vec()),
    });
    Log { time_s: log.time_s[rows.clone()].to_vec(), joints: joints.collect() }
}
