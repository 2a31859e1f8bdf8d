//! The whole of a file in memory, decompressed.

use std::io::Read;
use std::path::Path;

use flate2::read::MultiGzDecoder;

use super::error::{FileError, LocatedProblem, Place, Problem};

/// Reads a file, and decompresses it where the name ends in `.gz`.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, FileError> {
    content(path, std::fs::read(path).map_err(|error| unreadable(error).in_file(path))?)
}

/// What a file of that name and with these bytes holds.
pub(super) fn content(path: &Path, bytes: Vec<u8>) -> Result<Vec<u8>, FileError> {
    if bytes.is_empty() {
        return Err(Problem::Empty.in_file(path));
    }
    if !path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("gz")) {
        return Ok(bytes);
    }
    unpack(&bytes).map_err(|error| Problem::BrokenGzip(error).in_file(path))
}

/// The text in a file's bytes.
pub(super) fn text(path: &Path, bytes: Vec<u8>) -> Result<String, FileError> {
    check_text(&bytes).map_err(|fault| fault.in_file(path))?;
    Ok(String::from_utf8(bytes).unwrap_or_default())
}

/// Checks that all bytes are UTF-8; the fault names the line of the first that is not.
pub(super) fn check_text(bytes: &[u8]) -> Result<&str, LocatedProblem> {
    std::str::from_utf8(bytes).map_err(|error| {
        let (before, rest) = bytes.split_at(error.valid_up_to());
        let byte = rest.first().copied().unwrap_or_default();
        Problem::NotUtf8(byte).at(Place::line(line_at_end(before)))
    })
}

/// The line, from 1, on which the end of `text` lies.
pub(super) fn line_at_end(text: &[u8]) -> usize {
    1 + memchr::memchr_iter(b'\n', text).count()
}

fn unreadable(error: std::io::Error) -> Problem {
    match error.kind() {
        std::io::ErrorKind::NotFound => Problem::Missing,
        _ => Problem::Unreadable(error),
    }
}

fn unpack(packed: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut text = Vec::with_capacity(unpacked_size(packed));
    MultiGzDecoder::new(packed).read_to_end(&mut text)?;
    Ok(text)
}

/// The size that a gzip file's last four bytes promise, believed up to the format's
/// greatest ratio, so that a damaged file cannot claim all memory.
fn unpacked_size(packed: &[u8]) -> usize {
    const GREATEST_RATIO: usize = 1032;
    let promised = packed.last_chunk::<4>().map_or(0, |bytes| u32::from_le_bytes(*bytes));
    (promised as usize).min(packed.len().saturating_mul(GREATEST_RATIO))
}
