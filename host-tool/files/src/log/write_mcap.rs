//! Logs as MCAP, which Foxglove plots.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufWriter, Error};
use std::path::Path;

use mcap::records::MessageHeader;
use mcap::{Compression, McapError, WriteOptions, Writer};
use serde::Serialize;

use super::channel::Channel;
use super::joint_columns::JointColumns;
use super::{JointLog, Log, McapDetails};
use crate::error::{FileError, Place, Problem};
use crate::replace::replace_file;

/// Writes an MCAP file: a channel per joint, a message per sample; one for each encoder's counts where
/// angles are known too; the board's own if there is anything to write. Samples of the board beyond the
/// last row follow the rows.
pub(super) fn write(log: &Log, details: &McapDetails, path: &Path) -> Result<(), FileError> {
    let times_ns =
        times_ns(&log.time_s).map_err(|problem| problem.at(Place::column("t_s")).in_file(path))?;
    let began_ns = details.began_unix_ns;
    let times_ns: Vec<u64> = times_ns.into_iter().map(|t| began_ns.saturating_add(t)).collect();
    replace_file(path, |file| write_all(log, details, &times_ns, file).map_err(unwritable))
}

/// Times in nanoseconds, as MCAP has them.
fn times_ns(times_s: &[f64]) -> Result<Vec<u64>, Problem> {
    match times_s.first() {
        Some(&first) if first < 0.0 => Err(Problem::NegativeTime(first)),
        _ => Ok(times_s.iter().map(|time_s| (time_s * 1e9).round() as u64).collect()),
    }
}

fn write_all(
    log: &Log,
    details: &McapDetails,
    times_ns: &[u64],
    file: &mut BufWriter<&mut File>,
) -> Result<(), McapError> {
    let library = concat!("rrr ", env!("CARGO_PKG_VERSION"));
    let options = WriteOptions::new().compression(Some(Compression::Zstd)).library(library);
    let mut writer = options.create(file)?;
    let joints: Vec<JointChannels> = log
        .joints
        .iter()
        .map(|joint| JointChannels::add(&mut writer, log, joint, details))
        .collect::<Result<_, McapError>>()?;
    let board = details.board;
    let board_channel =
        if board.is_empty() { 0 } else { add_channel(&mut writer, &Channel::of_board())? };
    for (row, &time_ns) in times_ns.iter().enumerate() {
        for joint in &joints {
            joint.write(&mut writer, row, log.time_s[row], time_ns)?;
        }
        if let Some(sample) = board.get(row) {
            write_message(&mut writer, &header(board_channel, row, time_ns), sample)?;
        }
    }
    for (row, sample) in board.iter().enumerate().skip(times_ns.len()) {
        let time_ns = details.began_unix_ns.saturating_add((sample.t_s * 1e9).round() as u64);
        write_message(&mut writer, &header(board_channel, row, time_ns), sample)?;
    }
    writer.finish()?;
    Ok(())
}

/// The channels of a joint.
struct JointChannels<'a> {
    columns: JointColumns<'a>,
    channel: u16,
    count_channel: Option<u16>,
}

impl<'a> JointChannels<'a> {
    fn add<W: std::io::Write + std::io::Seek>(
        writer: &mut Writer<W>,
        log: &Log,
        joint: &'a JointLog,
        details: &McapDetails,
    ) -> Result<Self, McapError> {
        let columns = JointColumns::of(joint, &log.time_s, details.counts_per_rev);
        let channels = columns.channels(log.time_s[0]);
        let ids: Vec<u16> = channels
            .iter()
            .map(|channel| add_channel(writer, channel))
            .collect::<Result<_, McapError>>()?;
        let (channel, count_channel) = (ids[0], ids.get(1).copied());
        Ok(Self { columns, channel, count_channel })
    }

    fn write<W: std::io::Write + std::io::Seek>(
        &self,
        writer: &mut Writer<W>,
        row: usize,
        time_s: f64,
        time_ns: u64,
    ) -> Result<(), McapError> {
        let message = self.columns.message(row, time_s);
        write_message(writer, &header(self.channel, row, time_ns), &message)?;
        let count = self.count_channel.zip(self.columns.count_message(row, time_s));
        match count {
            Some((channel, message)) => {
                write_message(writer, &header(channel, row, time_ns), &message)
            }
            None => Ok(()),
        }
    }
}

fn header(channel_id: u16, row: usize, time_ns: u64) -> MessageHeader {
    MessageHeader { channel_id, sequence: row as u32, log_time: time_ns, publish_time: time_ns }
}

fn write_message<W>(
    writer: &mut Writer<W>,
    header: &MessageHeader,
    message: &impl Serialize,
) -> Result<(), McapError>
where
    W: std::io::Write + std::io::Seek,
{
    let text = serde_json::to_vec(message).map_err(Error::from)?;
    writer.write_to_known_channel(header, &text)
}

fn add_channel<W>(writer: &mut Writer<W>, channel: &Channel) -> Result<u16, McapError>
where
    W: std::io::Write + std::io::Seek,
{
    let Channel { topic, schema_name, schema } = channel;
    let schema_id = writer.add_schema(schema_name, "jsonschema", schema.as_bytes())?;
    writer.add_channel(schema_id, topic, "json", &BTreeMap::new())
}

fn unwritable(error: McapError) -> Problem {
    Problem::Unwritable(match error {
        McapError::Io(error) => error,
        other => Error::other(other),
    })
}
