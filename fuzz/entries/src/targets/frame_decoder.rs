//! Bytes of the line, as frames and as the messages in them, for both ends.

use firmware::frame::FrameReader;
use firmware::link::{ToBoard, ToHost};

/// Reads whatever frames there are.
pub fn run(bytes: &[u8]) {
    let mut reader = FrameReader::new();
    for &byte in bytes {
        if let Some(content) = reader.push(byte) {
            let _ = (ToBoard::read(content), ToHost::read(content));
        }
    }
    let _ = (ToBoard::read(bytes), ToHost::read(bytes));
}
