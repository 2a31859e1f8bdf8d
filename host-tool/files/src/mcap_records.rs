//! The records of an MCAP file that a log needs: schemas' names, channels and messages, read by hand.
//!
//! The library's own parser reserves what a string claims to be long, up to 4 GiB, before it
//! looks whether the string is there. Schemas' texts, metadata and indices are not looked at.

use std::collections::HashMap;
use std::io::Read;

use mcap::records::op::{CHANNEL, CHUNK, DATA_END, MESSAGE, SCHEMA};
use mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};
use mcap::{McapError, McapResult};

/// A message and what its channel says of it.
pub(super) struct TopicMessage<'a> {
    pub topic: &'a str,
    /// Name of the schema, empty where the channel has none.
    pub schema: &'a str,
    /// How the message is encoded.
    pub encoding: &'a str,
    /// Time at which it was logged [ns].
    pub log_time_ns: u64,
    pub data: &'a [u8],
}

/// Hands every message on, chunk by chunk, each chunk once its checksum is right.
///
/// Sizes stand in the file itself, so without a limit a damaged one claims all memory.
pub(super) fn for_each_message<E: From<McapError>>(
    bytes: &[u8],
    mut take: impl FnMut(TopicMessage<'_>) -> Result<(), E>,
) -> Result<(), E> {
    const LARGEST_CHUNK: usize = 64 << 20;
    check_plain_chunks(bytes)?;
    let options = LinearReaderOptions::default()
        .with_record_length_limit(bytes.len().saturating_add(LARGEST_CHUNK))
        .with_prevalidate_chunk_crcs(true);
    let mut reader = LinearReader::new_with_options(options);
    let (mut rest, mut channels, mut ended) = (bytes, Channels::default(), false);
    while let Some(event) = reader.next_event() {
        match event? {
            LinearReadEvent::ReadRequest(wanted) => {
                let read = rest.read(reader.insert(wanted)).map_err(McapError::from)?;
                reader.notify_read(read);
            }
            // Behind the end of the data channels are repeated, for who seeks in the file.
            LinearReadEvent::Record { opcode: DATA_END, .. } => ended = true,
            LinearReadEvent::Record { opcode: SCHEMA, data } if !ended => {
                channels.add_schema(data)?
            }
            LinearReadEvent::Record { opcode: CHANNEL, data } if !ended => channels.add(data)?,
            LinearReadEvent::Record { opcode: MESSAGE, data } if !ended => {
                take(channels.message(data)?)?;
            }
            LinearReadEvent::Record { .. } => {}
        }
    }
    Ok(())
}

/// Bytes of a record before its content: kind and length.
const RECORD_HEAD: usize = 9;
const MAGIC_BYTES: usize = 8;

/// Checks that records end with the file, and with their chunk where that is not compressed:
/// the library counts down without looking, and would read on behind it.
fn check_plain_chunks(bytes: &[u8]) -> McapResult<()> {
    let mut rest = bytes.get(MAGIC_BYTES..).unwrap_or_default();
    // The magic number stands at the end as well.
    while rest.len() > MAGIC_BYTES {
        let (opcode, content, behind) = record(rest).ok_or(McapError::UnexpectedEof)?;
        if opcode == CHUNK && !plain_records(content).is_none_or(is_whole) {
            return Err(McapError::UnexpectedEoc);
        }
        rest = behind;
    }
    Ok(())
}

/// Kind and content of the first record, and what follows it.
fn record(bytes: &[u8]) -> Option<(u8, &[u8], &[u8])> {
    let (head, rest) = bytes.split_first_chunk::<RECORD_HEAD>()?;
    let (opcode, length) = head.split_first()?;
    let length = u64::from_le_bytes(length.try_into().ok()?);
    let (content, behind) = rest.split_at_checked(usize::try_from(length).ok()?)?;
    Some((*opcode, content, behind))
}

/// The records of a chunk that is not compressed.
fn plain_records(chunk: &[u8]) -> Option<&[u8]> {
    // Two times, size and checksum of the records.
    let (_, chunk) = chunk.split_first_chunk::<28>()?;
    let (compression, chunk) = chunk.split_first_chunk::<4>()?;
    let (length, chunk) = chunk.split_first_chunk::<8>()?;
    let length = usize::try_from(u64::from_le_bytes(*length)).ok()?;
    (*compression == [0; 4]).then(|| chunk.get(..length)).flatten()
}

fn is_whole(mut records: &[u8]) -> bool {
    while let Some((_, _, behind)) = record(records) {
        records = behind;
    }
    records.is_empty()
}

/// The channels that were announced so far.
#[derive(Default)]
struct Channels {
    schemas: HashMap<u16, String>,
    channels: HashMap<u16, Channel>,
}

struct Channel {
    topic: String,
    schema: String,
    encoding: String,
}

impl Channels {
    fn add_schema(&mut self, data: &[u8]) -> McapResult<()> {
        let (id, data) = number(data)?;
        let (name, _) = text(data)?;
        self.schemas.insert(u16::from_le_bytes(id), name);
        Ok(())
    }

    fn add(&mut self, data: &[u8]) -> McapResult<()> {
        let (id, data) = number(data)?;
        let (schema, data) = number(data)?;
        let (topic, data) = text(data)?;
        let (encoding, _) = text(data)?;
        let schema = self.schemas.get(&u16::from_le_bytes(schema)).cloned().unwrap_or_default();
        self.channels.insert(u16::from_le_bytes(id), Channel { topic, schema, encoding });
        Ok(())
    }

    fn message<'a>(&'a self, data: &'a [u8]) -> McapResult<TopicMessage<'a>> {
        let (id, data) = number(data)?;
        let (sequence, data) = number(data)?;
        let (log_time, data) = number(data)?;
        let (_publish_time, data) = number::<8>(data)?;
        let (id, sequence) = (u16::from_le_bytes(id), u32::from_le_bytes(sequence));
        let channel = self.channels.get(&id).ok_or(McapError::UnknownChannel(sequence, id))?;
        let Channel { topic, schema, encoding } = channel;
        let log_time_ns = u64::from_le_bytes(log_time);
        Ok(TopicMessage { topic, schema, encoding, log_time_ns, data })
    }
}

/// A text behind its length, and what follows it.
fn text(data: &[u8]) -> McapResult<(String, &[u8])> {
    let (length, data) = number(data)?;
    let length = u32::from_le_bytes(length) as usize;
    let (text, rest) = data.split_at_checked(length).ok_or(McapError::UnexpectedEof)?;
    Ok((String::from_utf8_lossy(text).into_owned(), rest))
}

/// The first bytes, and what follows them.
fn number<const N: usize>(data: &[u8]) -> McapResult<([u8; N], &[u8])> {
    let (number, rest) = data.split_first_chunk().ok_or(McapError::UnexpectedEof)?;
    Ok((*number, rest))
}
