//! The latched fault in memory that a reset does not clear, until the flash has it too.
//!
//! Writing the flash takes milliseconds and waits for the line's task; this takes a tick. After
//! power-on the memory holds anything, so a record counts only with its checksum.

use super::fault::FaultRecord;
use crate::checksum::CRC_32C;

const RECORD_BYTES: usize = 24;
/// The first byte of a record that there is.
const FILLED: u8 = 0xFA;

/// A fault, or none, with a checksum.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Latch {
    record: [u8; RECORD_BYTES],
    checksum: u32,
}

impl Latch {
    /// Holds a fault, or none.
    pub fn of(fault: Option<&FaultRecord>) -> Self {
        let mut record = [0; RECORD_BYTES];
        if let (Some(fault), [first, rest @ ..]) = (fault, &mut record) {
            // A record has 19 bytes at most.
            *first = postcard::to_slice(fault, rest).map_or(0, |_| FILLED);
        }
        Self { record, checksum: CRC_32C.checksum(&record) }
    }

    /// The fault that it holds, if its checksum is right.
    pub fn fault(&self) -> Option<FaultRecord> {
        let [first, rest @ ..] = &self.record;
        let is_intact = CRC_32C.checksum(&self.record) == self.checksum;
        match is_intact && *first == FILLED {
            true => postcard::take_from_bytes(rest).ok().map(|(fault, _)| fault),
            false => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::supervisor::Fault;

    const LONGEST: FaultRecord = FaultRecord {
        fault: Fault::Converter,
        joint: u8::MAX,
        tick: u32::MAX,
        value: f32::MAX,
        limit: f32::MIN,
    };

    #[test]
    fn what_is_latched_is_found_and_a_flipped_bit_is_not_believed() {
        assert_eq!(Latch::of(None).fault(), None);
        let latch = Latch::of(Some(&LONGEST));
        assert_eq!(latch.fault(), Some(LONGEST));
        for bit in 0..8 * RECORD_BYTES {
            let mut flipped = latch;
            flipped.record[bit / 8] ^= 1 << (bit % 8);
            assert_eq!(flipped.fault(), None, "bit {bit}");
        }
        for word in [0, u32::MAX, 0xDEAD_BEEF] {
            let noise = Latch { record: [word as u8; RECORD_BYTES], checksum: word };
            assert_eq!(noise.fault(), None);
        }
    }
}
