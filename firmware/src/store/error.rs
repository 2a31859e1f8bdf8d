//! What can go wrong with the store, and where.

use embedded_storage::nor_flash::NorFlashErrorKind;

use super::layout::{Kind, Slot};
use crate::block::BlockError;

/// A place in flash: what it is for and where it lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// What is stored there.
    pub kind: Kind,
    /// The slot, or which of the two pages.
    pub slot: Slot,
    /// Its address.
    pub address: u32,
}

impl core::fmt::Display for Place {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{}, {} at 0x{:08X}", self.kind.name(), self.slot, self.address)
    }
}

/// What was asked of the flash.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// A page was to be erased.
    Erase,
    /// A record was to be written.
    Write,
    /// A record was to be read.
    Read,
}

/// Why something was not stored; what was in force before still is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StoreError {
    /// The flash refuses.
    Flash {
        /// What it was asked.
        operation: Operation,
        /// Where.
        place: Place,
        /// Its reason.
        kind: NorFlashErrorKind,
    },
    /// What was written is not what is read.
    ReadBack {
        /// Where.
        place: Place,
    },
    /// The block would not be taken at the next boot.
    Refused(BlockError),
    /// More bytes than the place holds.
    TooLong {
        /// What was to be stored.
        kind: Kind,
        /// Its length [bytes].
        bytes: usize,
        /// Room for it [bytes].
        room: usize,
    },
    /// Sequence numbers have run out, after 4 thousand million commits.
    WornOut,
}

impl core::fmt::Display for StoreError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Flash { operation, place, kind } => {
                let action = match operation {
                    Operation::Erase => "erased",
                    Operation::Write => "written",
                    Operation::Read => "read",
                };
                write!(f, "{place}: cannot be {action}: {kind}")
            }
            Self::ReadBack { place } => {
                write!(f, "{place}: what was written is not what is read back")
            }
            Self::Refused(error) => write!(f, "not stored: {error}"),
            Self::TooLong { kind, bytes, room } => {
                write!(f, "the {} has {bytes} bytes, there is room for {room}", kind.name())
            }
            Self::WornOut => write!(f, "sequence numbers have run out"),
        }
    }
}

impl core::error::Error for StoreError {}
