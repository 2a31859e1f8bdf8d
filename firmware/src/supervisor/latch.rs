//! What a board that is reset must know at its next boot, in memory that a reset does not clear:
//! the latched fault, until the flash has it too, or that it was armed.
//!
//! Writing the flash takes milliseconds and waits for the line's task; this takes a tick. After
//! power-on the memory holds anything, so what is there counts only with its checksum.

use super::fault::FaultRecord;
use crate::checksum::CRC_32C;

const RECORD_BYTES: usize = 24;
/// The first byte where there is a fault, and where the board is armed.
const FILLED: u8 = 0xFA;
const ARMED: u8 = 0xA5;

/// What is kept over a reset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kept {
    /// The board is at 0 V, and no fault is latched.
    Nothing,
    /// It is armed, or it runs: a reset now is a fault.
    Armed,
    /// A fault is latched.
    Fault(FaultRecord),
}

impl Kept {
    /// The latched fault.
    pub fn fault(self) -> Option<FaultRecord> {
        match self {
            Self::Fault(record) => Some(record),
            Self::Nothing | Self::Armed => None,
        }
    }
}

/// The same with a checksum.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Latch {
    record: [u8; RECORD_BYTES],
    checksum: u32,
}

impl Latch {
    /// Holds it.
    pub fn of(kept: &Kept) -> Self {
        let mut record = [0; RECORD_BYTES];
        let [first, rest @ ..] = &mut record;
        *first = match kept {
            Kept::Nothing => 0,
            Kept::Armed => ARMED,
            // A record has 19 bytes at most.
            Kept::Fault(fault) => postcard::to_slice(fault, rest).map_or(0, |_| FILLED),
        };
        Self { record, checksum: CRC_32C.checksum(&record) }
    }

    /// What it holds, if its checksum is right.
    pub fn kept(&self) -> Kept {
        let [first, rest @ ..] = &self.record;
        let is_intact = CRC_32C.checksum(&self.record) == self.checksum;
        match *first {
            FILLED if is_intact => postcard::take_from_bytes(rest)
                .map_or(Kept::Nothing, |(fault, _)| Kept::Fault(fault)),
            ARMED if is_intact => Kept::Armed,
            _ => Kept::Nothing,
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
    fn what_is_kept_is_found_and_a_flipped_bit_is_not_believed() {
        assert_eq!(Latch::of(&Kept::Nothing).kept(), Kept::Nothing);
        for kept in [Kept::Armed, Kept::Fault(LONGEST)] {
            let latch = Latch::of(&kept);
            assert_eq!(latch.kept(), kept);
            for bit in 0..8 * RECORD_BYTES {
                let mut flipped = latch;
                flipped.record[bit / 8] ^= 1 << (bit % 8);
                assert_eq!(flipped.kept(), Kept::Nothing, "bit {bit}");
            }
        }
        for word in [0, u32::MAX, 0xDEAD_BEEF, 0xA5A5_A5A5] {
            let noise = Latch { record: [word as u8; RECORD_BYTES], checksum: word };
            assert_eq!(noise.kept(), Kept::Nothing);
        }
    }
}
