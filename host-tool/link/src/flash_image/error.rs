//! Why a board's flash is not written.

use std::path::PathBuf;

use firmware::BlockError;
use firmware::store::Slot;

/// What is wrong with an image, or with writing it.
#[derive(Debug, thiserror::Error)]
pub enum FlashError {
    /// The file does not hold a program for the board.
    #[error("{}: is no 32-bit ELF file: {why}", path.display())]
    NotElf {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
    },
    /// The file holds nothing for flash.
    #[error("{}: holds nothing that goes into flash", path.display())]
    NoProgram {
        /// The file.
        path: PathBuf,
    },
    /// Bytes where the board has no flash.
    #[error(
        "the image has bytes from 0x{address:08X} to 0x{end:08X}; the board's flash is from \
         0x08000000 to 0x08080000"
    )]
    NotFlash {
        /// First address.
        address: u32,
        /// Behind the last.
        end: u64,
    },
    /// Bytes in bank 2, and not in the slot chosen.
    #[error(
        "the image has bytes from 0x{address:08X} to 0x{end:08X}, in bank 2; there it may touch \
         {} alone", allowed(*chosen)
    )]
    NotTheSlot {
        /// First address.
        address: u32,
        /// Behind the last.
        end: u64,
        /// The slot that may be written.
        chosen: Option<Slot>,
    },
    /// Two pieces want the same place.
    #[error("two pieces of the image both have bytes at 0x{address:08X}")]
    Overlap {
        /// An address in both.
        address: u32,
    },
    /// The block cannot be used.
    #[error(transparent)]
    Block(#[from] BlockError),
    /// The block is longer than a slot.
    #[error("the block has {bytes} bytes, which a slot does not hold")]
    TooLong {
        /// Its length [bytes].
        bytes: usize,
    },
    /// There is no sequence number above the board's.
    #[error("the board's sequence numbers have run out")]
    WornOut,
    /// No probe at any port.
    #[error("no debug probe is connected")]
    NoProbe,
    /// More than one.
    #[error("{} debug probes are connected: {}", names.len(), names.join(", "))]
    ManyProbes {
        /// What each is called.
        names: Vec<String>,
    },
    /// A name that is no probe's.
    #[error("`{name}` is no probe's name: {why}")]
    ProbeName {
        /// The name given.
        name: String,
        /// What is wrong with it.
        why: String,
    },
    /// The probe or the chip does not answer.
    #[error("the probe cannot {action}: {why}")]
    Probe {
        /// What it was asked to do.
        action: &'static str,
        /// What it says.
        why: String,
    },
    /// What was written is not there afterwards.
    #[error("at 0x{address:08X} the flash does not hold what was written")]
    Verify {
        /// The first address that differs.
        address: u32,
    },
    /// What was not to be written has changed.
    #[error(
        "at 0x{address:08X} ({place}) the flash was not to be touched and has changed all the same"
    )]
    OthersChanged {
        /// The first address that has changed.
        address: u32,
        /// What is kept there.
        place: String,
    },
    /// The tool was built without probe-rs.
    #[error("this `rrr` was built without the feature `probe`")]
    NoProbeSupport,
}

fn allowed(chosen: Option<Slot>) -> String {
    chosen.map_or_else(|| "nothing".into(), |slot| slot.to_string())
}
