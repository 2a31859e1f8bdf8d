//! Frames with a checksum: kind, payload, CRC-32C, all inside COBS, ended by a zero.

use cobs::CobsEncoder;

use crate::checksum::CRC_32C;
use crate::frame::MAX_CONTENT_BYTES;

/// Longest frame on the line, with its zero [bytes].
pub const MAX_FRAME_BYTES: usize = MAX_CONTENT_BYTES + MAX_CONTENT_BYTES / 254 + 2;
/// Longest payload of a frame [bytes].
pub const MAX_PAYLOAD_BYTES: usize = MAX_CONTENT_BYTES - KIND_BYTES - CHECKSUM_BYTES;

const KIND_BYTES: usize = 1;
const CHECKSUM_BYTES: usize = 4;

/// What a frame holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A Hello, of the host or of the board: [`super::hello`].
    Hello = b'H' as isize,
    /// A request of the host in postcard: [`super::Request`].
    Request = b'Q' as isize,
    /// An answer of the board in postcard: [`super::Answer`].
    Answer = b'A' as isize,
    /// A tick in postcard: [`super::Telemetry`].
    Telemetry = b'T' as isize,
}

impl Kind {
    fn of_byte(byte: u8) -> Option<Self> {
        let all = [Self::Hello, Self::Request, Self::Answer, Self::Telemetry];
        all.into_iter().find(|kind| *kind as u8 == byte)
    }
}

/// Writes a frame with its zero into `buffer`, returns the bytes written.
///
/// `None` if the payload is longer than [`MAX_PAYLOAD_BYTES`] or the buffer too small.
pub fn seal<'a>(kind: Kind, payload: &[u8], buffer: &'a mut [u8]) -> Option<&'a [u8]> {
    if payload.len() > MAX_PAYLOAD_BYTES {
        return None;
    }
    let kind = [kind as u8];
    let mut digest = CRC_32C.digest();
    digest.update(&kind);
    digest.update(payload);
    let mut encoder = CobsEncoder::new(buffer);
    encoder.push(&kind).ok()?;
    encoder.push(payload).ok()?;
    encoder.push(&digest.finalize().to_le_bytes()).ok()?;
    let length = encoder.finalize();
    *buffer.get_mut(length)? = 0;
    buffer.get(..=length)
}

/// Kind and payload of a frame's content; `None` if it is broken or of unknown kind.
pub fn open(content: &[u8]) -> Option<(Kind, &[u8])> {
    let (sealed, checksum) = content.split_last_chunk::<CHECKSUM_BYTES>()?;
    if CRC_32C.checksum(sealed) != u32::from_le_bytes(*checksum) {
        return None;
    }
    let (kind, payload) = sealed.split_first()?;
    Some((Kind::of_byte(*kind)?, payload))
}
