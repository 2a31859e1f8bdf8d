//! What the host asks; types only, as the schema hash is taken of this text.

use serde::{Deserialize, Serialize};

use crate::Angle;

/// Most bytes of a parameter block in one [`Command::UploadPiece`] or [`Command::Download`].
pub const PIECE_BYTES: usize = 192;

/// A numbered request; each gets one answer with the same number.
///
/// Numbers rise by any step from request to request, beginning anew after a Hello.
/// A request that comes again with the number and the bytes of the last one is
/// not carried out again: the last answer is given again.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Request<'a> {
    /// Its number.
    pub number: u32,
    /// Where the board has a key: [`crate::link::key::proof`] of this command.
    pub proof: Option<[u8; 32]>,
    /// What shall be done.
    #[serde(borrow)]
    pub command: Command<'a>,
}

/// What the host can ask for. "Key" marks what needs a proof on a board that has a key.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Command<'a> {
    /// How is the board? Answered by a `Report`; also the host's sign of life.
    Query,
    /// Have the board send telemetry every tick, or no more.
    Stream {
        /// Whether it is sent.
        on: bool,
    },
    /// Give me a number that proofs are made with, until the next Hello or Challenge.
    Challenge,
    /// An encoded parameter block follows in pieces. Key. Any state but Faulted, Armed, Running.
    UploadBegin {
        /// Bytes of the whole encoded block.
        length: u16,
        /// CRC-32C of the whole encoded block.
        checksum: u32,
    },
    /// The next piece; pieces follow one another without a gap. Key.
    UploadPiece {
        /// Where it belongs, from the beginning of the block [bytes].
        offset: u16,
        /// At most [`PIECE_BYTES`].
        #[serde(borrow)]
        bytes: &'a [u8],
    },
    /// Check what was uploaded as a whole and use it until the next reset. Key.
    Use,
    /// Check what was uploaded as a whole, store it for good, read it back and use it. Key.
    Commit,
    /// A piece of a parameter block; answered by a `Piece`.
    Download {
        /// Which block.
        source: Source,
        /// From where on, from the beginning of the block [bytes].
        offset: u16,
    },
    /// From Disarmed to Armed, still at 0 V; refused if the estimates are implausible. Key.
    Arm,
    /// From Armed to Running: the reference begins at the next tick. Key.
    Run {
        /// The run ends in the fault `LinkLost` if the host is silent for longer [ms], or for longer than
        /// the board's hard limit, which holds for `None` too.
        host_timeout_ms: Option<u16>,
    },
    /// From Running to Armed: 0 V from the next tick on.
    Stop,
    /// From Armed or Running to Disarmed: 0 V from the next tick on.
    Disarm,
    /// From Faulted to Disarmed, unless the cause is still there. Key.
    ClearFault,
    /// The joints, at rest, are here; Disarmed only. Needed where encoders count from zero at
    /// power-on. Key.
    Home {
        /// Where each joint is.
        position: [Angle; 3],
    },
    /// Set the key, change it, or with `None` remove it; Disarmed only. Key, once one is set.
    ///
    /// The key itself goes over the line: do this at the rig, over a line of your own.
    SetKey {
        /// The new key.
        key: Option<[u8; 32]>,
    },
}

/// Which parameter block is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Source {
    /// The one that the next run is made with.
    InUse,
    /// The newest valid one in the store, as the next boot finds it.
    Stored,
}
