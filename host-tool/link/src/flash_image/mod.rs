//! What is written into the board's flash, and where: checked against the memory map before a
//! probe is touched.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`parameters`] | a parameter block as the record of a slot |
//! | [`elf`] | the firmware's file |
//! | [`check`] | what may be written where |
//! | [`hex`] | images as files for other programmers |
//! | `probe` | the board at the end of a debug probe (feature `probe`) |

pub mod check;
pub mod elf;
mod error;
pub mod hex;
pub mod parameters;
#[cfg(feature = "probe")]
pub mod probe;

pub use error::FlashError;

/// Bytes for one place in flash.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    /// Address of the first byte.
    pub address: u32,
    /// What is to be there.
    pub bytes: Vec<u8>,
}

impl Piece {
    /// The address behind the last byte; beyond 32 bits, if need be.
    pub fn end(&self) -> u64 {
        u64::from(self.address) + self.bytes.len() as u64
    }
}

/// What is written in one go.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FlashImage {
    /// The pieces, in no order.
    pub pieces: Vec<Piece>,
}

impl FlashImage {
    /// All bytes to be written.
    pub fn bytes(&self) -> usize {
        self.pieces.iter().map(|piece| piece.bytes.len()).sum()
    }
}
