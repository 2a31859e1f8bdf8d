//! Images as files that other programmers read.

use ihex::Record;

use super::{FlashImage, Piece};

/// Bytes in a line of Intel HEX.
const LINE_BYTES: usize = 16;

impl FlashImage {
    /// The image as Intel HEX, with its addresses.
    pub fn intel_hex(&self) -> String {
        let mut records: Vec<Record> = self.pieces.iter().flat_map(records).collect();
        records.push(Record::EndOfFile);
        // Lines are short and the file ends, so there is nothing that it could object to.
        ihex::create_object_file_representation(&records).unwrap_or_default()
    }
}

fn records(piece: &Piece) -> Vec<Record> {
    let mut records = Vec::new();
    let mut upper = None;
    for (address, line) in (piece.address..).step_by(LINE_BYTES).zip(piece.bytes.chunks(LINE_BYTES))
    {
        let half = (address >> 16) as u16;
        if upper.replace(half) != Some(half) {
            records.push(Record::ExtendedLinearAddress(half));
        }
        records.push(Record::Data { offset: address as u16, value: line.to_vec() });
    }
    records
}
