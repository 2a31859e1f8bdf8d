//! Logs from MCAP.

use std::path::Path;

use serde::de::DeserializeOwned;

use super::joint_message::{CountMessage, JointMessage, count_topic, topic};
use super::{JointLog, Log, Position};
use crate::error::{FileError, LocatedProblem, Problem};
use crate::mcap_records::{TopicMessage, for_each_message};

/// The log in an MCAP file's bytes, as this tool writes it; the path is for messages.
pub(super) fn of(path: &Path, bytes: &[u8]) -> Result<Log, FileError> {
    log_from(bytes).map_err(|fault| fault.in_file(path))
}

/// The log that an MCAP file's messages make; messages on other topics are ignored.
pub(super) fn log_from(bytes: &[u8]) -> Result<Log, LocatedProblem> {
    let mut joints: [Samples; 3] = Default::default();
    let topics = [1, 2, 3].map(|joint| [topic(joint), count_topic(joint)]);
    for_each_message(bytes, |message| {
        let of_joint = |names: &[String; 2]| names.iter().position(|name| name == message.topic);
        let place = topics.iter().enumerate().find_map(|(i, names)| Some((i, of_joint(names)?)));
        match place {
            Some((joint, 0)) => joints[joint].push(&message),
            Some((joint, _)) => joints[joint].push_count(&message),
            None => Ok(()),
        }
    })?;
    let log = join((1..).zip(joints).filter(|(_, samples)| !samples.time_s.is_empty()))?;
    log.check().map_err(LocatedProblem::without_line)?;
    Ok(log)
}

/// One joint's messages, column by column.
#[derive(Default)]
struct Samples {
    time_s: Vec<f64>,
    counts: Vec<i64>,
    /// Counts of a channel of their own, which go before angles: these follow from them.
    own_counts: Vec<i64>,
    angles_rad: Vec<f64>,
    command_v: Vec<f64>,
    reference_rad: Vec<f64>,
}

impl Samples {
    fn push(&mut self, message: &TopicMessage<'_>) -> Result<(), Problem> {
        let sample: JointMessage = parsed(message, self.time_s.len())?;
        self.time_s.push(sample.t_s.unwrap_or(message.log_time_ns as f64 / 1e9));
        self.counts.extend(sample.position_count);
        self.angles_rad.extend(sample.position_rad);
        self.command_v.push(sample.command_v);
        self.reference_rad.extend(sample.reference_rad);
        Ok(())
    }

    fn push_count(&mut self, message: &TopicMessage<'_>) -> Result<(), Problem> {
        let sample: CountMessage = parsed(message, self.own_counts.len())?;
        self.own_counts.push(sample.position_count);
        Ok(())
    }

    /// The joint's columns; those that are not as long as the time are found by the check.
    fn into_joint(self, joint: u8) -> Result<JointLog, Problem> {
        let position = match (self.counts.is_empty(), self.angles_rad.is_empty()) {
            _ if !self.own_counts.is_empty() => Position::Count(self.own_counts),
            (false, false) => return Err(Problem::BothPositions(joint)),
            (true, _) => Position::Radian(self.angles_rad),
            (_, true) => Position::Count(self.counts),
        };
        let reference_rad = Some(self.reference_rad).filter(|values| !values.is_empty());
        Ok(JointLog { joint, position, command_v: self.command_v, reference_rad })
    }
}

/// A message, of which so many came before.
fn parsed<T: DeserializeOwned>(message: &TopicMessage<'_>, before: usize) -> Result<T, Problem> {
    serde_json::from_slice(message.data).map_err(|error| Problem::BrokenMessage {
        topic: message.topic.to_owned(),
        number: before + 1,
        what: error.to_string(),
    })
}

/// Joins the joints to a log; all must have the same times.
fn join(joints: impl Iterator<Item = (u8, Samples)>) -> Result<Log, Problem> {
    let mut log = Log::default();
    for (joint, mut samples) in joints {
        let time_s = std::mem::take(&mut samples.time_s);
        if log.joints.is_empty() {
            log.time_s = time_s;
        } else if log.time_s != time_s {
            let first = log.joints[0].joint;
            let what = format!("joints {first} and {joint} have messages at different times");
            return Err(Problem::Contradiction(what));
        }
        log.joints.push(samples.into_joint(joint)?);
    }
    Ok(log)
}
