//! What the board answers; types only, as the schema hash is taken of this text.

use heapless::String;
use serde::{Deserialize, Serialize};

use crate::supervisor::fault::{FaultRecord, Implausible, State};

/// The answer to the request of the same number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer<'a> {
    /// The request's number.
    pub number: u32,
    /// What came of it.
    #[serde(borrow)]
    pub result: Result<Reply<'a>, Refusal>,
}

/// What a request that was carried out brings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Reply<'a> {
    /// It is done.
    Done,
    /// To `Query`.
    Report(Report),
    /// To `Challenge`: what proofs are made with until the next Hello or Challenge.
    Challenge {
        /// Never the same twice.
        nonce: [u8; 16],
    },
    /// To `Download`.
    Piece {
        /// Bytes of the whole encoded block.
        length: u16,
        /// CRC-32C of the whole encoded block.
        checksum: u32,
        /// From the offset that was asked for; empty beyond the end.
        #[serde(borrow)]
        bytes: &'a [u8],
    },
    /// To `Use` and `Commit`: the block is in use, and after `Commit` stored and read back.
    InUse(Parameters),
}

/// How the board is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// What it is doing.
    pub state: State,
    /// The first cause, while Faulted.
    pub fault: Option<FaultRecord>,
    /// Whether the counts of each joint are those from the model's zero.
    pub position_known: [bool; 3],
    /// The parameter block in use; `None`: there is none, not even safe defaults.
    pub parameters: Option<Parameters>,
    /// Whether a key protects upload, arm, run and fault clearing. If not, the link is open.
    pub has_key: bool,
    /// What has been counted since power-on.
    pub counters: Counters,
}

/// Which parameter block is in use.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Parameters {
    /// Where it comes from.
    pub origin: Origin,
    /// Bytes of the encoded block.
    pub length: u16,
    /// CRC-32C of the encoded block.
    pub checksum: u32,
}

/// Where the parameter block in use comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Origin {
    /// The newest in the store.
    Newest,
    /// The older slot: the newer one is not whole.
    Older,
    /// Nothing valid is stored: safe defaults, feedforward off.
    SafeDefaults,
    /// Uploaded for use until the next reset.
    Uploaded,
}

/// Counts since power-on, wrapping.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counters {
    /// Ticks.
    pub ticks: u32,
    /// Ticks that were not done when the next one was due.
    pub overruns: u32,
    /// Longest tick [0.1 us].
    pub longest_tick_tenth_us: u32,
    /// Ticks in which a joint's command was cut at its limit. A limit, not a fault.
    pub saturated: [u32; 3],
    /// Telemetry records that the board could not send. A limit, not a fault.
    pub telemetry_dropped: u32,
    /// Frames that came in broken.
    pub frames_broken: u32,
    /// Requests that were carried out.
    pub requests: u32,
}

/// Why a request was not carried out. Nothing has changed, unless it says so.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Refusal {
    /// No Hello since the board's last reset: begin the conversation anew.
    HelloFirst,
    /// The number is not above that of a request already answered.
    OldNumber {
        /// The newest number so far.
        newest: u32,
    },
    /// Not in this state.
    NotNow {
        /// The state.
        state: State,
    },
    /// The board has a key, and the request no proof, a wrong one, or one without a challenge.
    Proof,
    /// No parameter block is in use.
    NoParameters,
    /// An estimate cannot be right.
    Implausible {
        /// The joint, 1 to 3.
        joint: u8,
        /// What is wrong with it.
        why: Implausible,
    },
    /// The reference begins further from where the joint is than the limit of a start allows.
    FarFromStart {
        /// The joint, 1 to 3.
        joint: u8,
        /// How far it has to go to the reference's beginning [rad].
        distance_rad: f32,
    },
    /// The cause of the fault is still there.
    FaultPersists,
    /// The upload's pieces do not follow one another, or are too many; begin anew or go on there.
    Upload {
        /// Bytes taken so far.
        taken: u16,
    },
    /// The uploaded bytes are not the block that was announced, or no valid block.
    Block(BlockRefusal),
    /// The store does not do what it should.
    Store(StoreRefusal),
    /// After `Commit`: the block is stored for the next reset, but a fault came between: the old
    /// one is still in use.
    StoredNotInUse,
    /// The emergency stop is pressed, or its wire is broken.
    EmergencyStop,
    /// The amplifiers have no power, or the wire that says so is broken.
    NoDrivePower,
    /// A joint is outside its range.
    OutsideRange {
        /// The joint, 1 to 3.
        joint: u8,
        /// Where it is [rad].
        position_rad: f32,
    },
}

/// Why a parameter block is refused.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum BlockRefusal {
    /// Its length is not the one announced, or more than a block may have.
    Length,
    /// Its layout has another version than this firmware's.
    Version {
        /// The version found.
        found: u16,
    },
    /// A checksum does not fit.
    Checksum,
    /// The bytes are not a block though the checksum fits.
    Layout,
    /// A value that no robot or not this board can have.
    Value {
        /// Its name.
        name: String<32>,
        /// The joint, 1 to 3, or 0 for the whole robot.
        joint: u8,
        /// The value found.
        value: f32,
        /// What it must.
        must: String<56>,
    },
}

/// What went wrong in the store.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum StoreRefusal {
    /// It could not be erased or written.
    Write,
    /// What was read back is not what was written.
    ReadBack,
    /// Nothing valid is stored.
    Empty,
    /// The block does not fit into a slot.
    TooLong,
}
