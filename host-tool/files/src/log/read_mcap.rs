//! Logs from MCAP.

use std::path::Path;

use super::joint_message::{JointMessage, topic};
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
    let topics = [1, 2, 3].map(topic);
    for_each_message(bytes, |message| {
        match topics.iter().position(|topic| topic == message.topic) {
            Some(index) => joints[index].push(&message),
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
    angles_rad: Vec<f64>,
    command_v: Vec<f64>,
    reference_rad: Vec<f64>,
}

impl Samples {
    fn push(&mut self, message: &TopicMessage<'_>) -> Result<(), Problem> {
        let sample: JointMessage =
            serde_json::from_slice(message.data).map_err(|error| Problem::BrokenMessage {
                topic: message.topic.to_owned(),
                number: self.time_s.len() + 1,
                what: error.to_string(),
            })?;
        self.time_s.push(sample.t_s.unwrap_or(message.log_time_ns as f64 / 1e9));
        self.counts.extend(sample.position_count);
        self.angles_rad.extend(sample.position_rad);
        self.command_v.push(sample.command_v);
        self.reference_rad.extend(sample.reference_rad);
        Ok(())
    }

    /// The joint's columns; those that are not as long as the time are found by the check.
    fn into_joint(self, joint: u8) -> Result<JointLog, Problem> {
        let position = match (self.counts.is_empty(), self.angles_rad.is_empty()) {
            (false, false) => return Err(Problem::BothPositions(joint)),
            (true, _) => Position::Radian(self.angles_rad),
            (_, true) => Position::Count(self.counts),
        };
        let reference_rad = Some(self.reference_rad).filter(|values| !values.is_empty());
        Ok(JointLog { joint, position, command_v: self.command_v, reference_rad })
    }
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
