//! Logs as MCAP, which Foxglove plots.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufWriter, Error};
use std::path::Path;

use mcap::records::MessageHeader;
use mcap::{McapError, WriteOptions, Writer};
use serde::Serialize;

use super::board_message;
use super::joint_message::{JointMessage, channel};
use super::{BoardSample, JointLog, Log};
use crate::error::{FileError, Place, Problem};
use crate::replace::replace_file;

/// Writes an MCAP file: a channel per joint, a message per sample; the board's own channel if
/// there is anything to write. Samples of the board beyond the last row follow the rows.
pub(super) fn write(log: &Log, board: &[BoardSample], path: &Path) -> Result<(), FileError> {
    let times_ns =
        times_ns(&log.time_s).map_err(|problem| problem.at(Place::column("t_s")).in_file(path))?;
    replace_file(path, |file| write_all(log, board, &times_ns, file).map_err(unwritable))
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
    board: &[BoardSample],
    times_ns: &[u64],
    file: &mut BufWriter<&mut File>,
) -> Result<(), McapError> {
    let library = concat!("rrr ", env!("CARGO_PKG_VERSION"));
    // Plain, so that any reader takes it.
    let options = WriteOptions::new().compression(None).library(library);
    let mut writer = options.create(file)?;
    let channels = add_channels(&mut writer, &log.joints)?;
    let board_channel = if board.is_empty() { 0 } else { add_board_channel(&mut writer)? };
    for (row, &time_ns) in times_ns.iter().enumerate() {
        for (joint, &channel_id) in log.joints.iter().zip(&channels) {
            let message = JointMessage::of(joint, row, log.time_s[row]);
            write_message(&mut writer, &header(channel_id, row, time_ns), &message)?;
        }
        if let Some(sample) = board.get(row) {
            write_message(&mut writer, &header(board_channel, row, time_ns), sample)?;
        }
    }
    for (row, sample) in board.iter().enumerate().skip(times_ns.len()) {
        let time_ns = (sample.t_s * 1e9).round() as u64;
        write_message(&mut writer, &header(board_channel, row, time_ns), sample)?;
    }
    writer.finish()?;
    Ok(())
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

fn add_channels<W>(writer: &mut Writer<W>, joints: &[JointLog]) -> Result<Vec<u16>, McapError>
where
    W: std::io::Write + std::io::Seek,
{
    joints.iter().map(|joint| add_channel(writer, joint)).collect()
}

fn add_channel<W>(writer: &mut Writer<W>, joint: &JointLog) -> Result<u16, McapError>
where
    W: std::io::Write + std::io::Seek,
{
    let channel = channel(joint);
    let schema_id = match &channel.schema {
        Some(schema) => writer.add_schema(&schema.name, &schema.encoding, &schema.data)?,
        None => 0,
    };
    let encoding = &channel.message_encoding;
    writer.add_channel(schema_id, &channel.topic, encoding, &channel.metadata)
}

fn add_board_channel<W>(writer: &mut Writer<W>) -> Result<u16, McapError>
where
    W: std::io::Write + std::io::Seek,
{
    let schema = board_message::schema();
    let schema_id = writer.add_schema(board_message::NAME, "jsonschema", schema.as_bytes())?;
    writer.add_channel(schema_id, board_message::TOPIC, "json", &BTreeMap::new())
}

fn unwritable(error: McapError) -> Problem {
    Problem::Unwritable(match error {
        McapError::Io(error) => error,
        other => Error::other(other),
    })
}
