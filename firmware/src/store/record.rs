//! A record in flash: header, mark, body.
//!
//! | byte | what |
//! | --- | --- |
//! | 0 | magic number, with the kind |
//! | 4 | sequence number: the higher, the newer |
//! | 8 | length of the body |
//! | 10 | layout of this table, 1 |
//! | 12 | CRC-32 of bytes 0 to 11 and of the body, filled up to whole words |
//! | 16 | the mark: sequence number, and its bits turned round |
//! | 24 | the body, filled up with ones to whole words of 8 bytes |
//!
//! The mark is written last, once all else has been read back. Every word of 8
//! bytes is written once: the G474 keeps a checksum for each.

use super::layout::{Kind, Layout, NOTE_PLACE_BYTES};
use crate::block::MAX_BYTES;
use crate::checksum::CRC_32;

/// The flash is written in words of so many bytes.
pub(super) const WORD_BYTES: usize = 8;
/// Bytes before the mark.
pub(super) const HEADER_BYTES: usize = 16;
/// Where the body begins.
pub(super) const BODY_AT: usize = HEADER_BYTES + WORD_BYTES;
/// Room for a body in memory: a block, filled up to whole words.
pub(super) const BODY_ROOM: usize = whole_words(MAX_BYTES);
/// No small record (fault or key) is longer [bytes].
pub const NOTE_BYTES: usize = NOTE_PLACE_BYTES as usize - BODY_AT;

const _: () = assert!(BODY_AT + BODY_ROOM <= Layout::G474.page_bytes as usize);

const LAYOUT: u16 = 1;
const ONES: [u8; WORD_BYTES] = [0xFF; WORD_BYTES];

/// The header of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub sequence: u32,
    pub length: u16,
    pub checksum: u32,
}

impl Header {
    /// The header for a body.
    pub fn of(kind: Kind, sequence: u32, body: &[u8]) -> Self {
        let length = body.len() as u16;
        let mut digest = CRC_32.digest();
        digest.update(&summed(kind, sequence, length));
        digest.update(body);
        digest.update(&ONES[..whole_words(body.len()) - body.len()]);
        Self { sequence, length, checksum: digest.finalize() }
    }

    pub fn encode(&self, kind: Kind) -> [u8; HEADER_BYTES] {
        let mut bytes = [0; HEADER_BYTES];
        bytes[..12].copy_from_slice(&summed(kind, self.sequence, self.length));
        bytes[12..].copy_from_slice(&self.checksum.to_le_bytes());
        bytes
    }

    /// The header in these bytes, if they begin as one.
    pub fn decode(kind: Kind, bytes: &[u8; HEADER_BYTES]) -> Option<Self> {
        let word =
            |i: usize| u32::from_le_bytes([bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]]);
        let half = |i: usize| u16::from_le_bytes([bytes[i], bytes[i + 1]]);
        let header = Self { sequence: word(4), length: half(8), checksum: word(12) };
        (word(0) == magic(kind) && half(10) == LAYOUT).then_some(header)
    }

    /// Whether the body, with what fills it up, is the one that the header was made for.
    pub fn fits(&self, kind: Kind, filled_body: &[u8]) -> bool {
        let mut digest = CRC_32.digest();
        digest.update(&summed(kind, self.sequence, self.length));
        digest.update(filled_body);
        digest.finalize() == self.checksum
    }
}

fn magic(kind: Kind) -> u32 {
    let letter = match kind {
        Kind::Parameters => b'P',
        Kind::Fault => b'F',
        Kind::Key => b'K',
    };
    u32::from_le_bytes([b'R', b'R', b'R', letter])
}

fn summed(kind: Kind, sequence: u32, length: u16) -> [u8; 12] {
    let mut bytes = [0; 12];
    bytes[..4].copy_from_slice(&magic(kind).to_le_bytes());
    bytes[4..8].copy_from_slice(&sequence.to_le_bytes());
    bytes[8..10].copy_from_slice(&length.to_le_bytes());
    bytes[10..].copy_from_slice(&LAYOUT.to_le_bytes());
    bytes
}

/// Bytes of the words that hold so many bytes.
pub(super) const fn whole_words(bytes: usize) -> usize {
    bytes.next_multiple_of(WORD_BYTES)
}

/// The mark of a valid record.
pub(super) fn mark(sequence: u32) -> [u8; WORD_BYTES] {
    let mut bytes = [0; WORD_BYTES];
    bytes[..4].copy_from_slice(&sequence.to_le_bytes());
    bytes[4..].copy_from_slice(&(!sequence).to_le_bytes());
    bytes
}

/// The sequence number in a mark, if it is one.
pub(super) fn marked(bytes: &[u8; WORD_BYTES]) -> Option<u32> {
    let sequence = u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    (*bytes == mark(sequence)).then_some(sequence)
}

/// The last word of a body, filled up with ones; `rest` is shorter than a word.
pub(super) fn filled(rest: &[u8]) -> [u8; WORD_BYTES] {
    let mut word = ONES;
    for (to, from) in word.iter_mut().zip(rest) {
        *to = *from;
    }
    word
}

/// The record that [`Store::commit`](crate::store::Store::commit) would leave in a slot.
///
/// `buffer` takes it; `None` if it is too short.
pub fn slot_record<'a>(sequence: u32, encoded: &[u8], buffer: &'a mut [u8]) -> Option<&'a [u8]> {
    let kind = Kind::Parameters;
    let record = buffer.get_mut(..BODY_AT + whole_words(encoded.len()))?;
    record.fill(0xFF);
    record[..HEADER_BYTES].copy_from_slice(&Header::of(kind, sequence, encoded).encode(kind));
    record[HEADER_BYTES..BODY_AT].copy_from_slice(&mark(sequence));
    record[BODY_AT..BODY_AT + encoded.len()].copy_from_slice(encoded);
    Some(record)
}
