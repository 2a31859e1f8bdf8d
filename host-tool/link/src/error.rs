//! Why a conversation with the board does not come about.

use firmware::BlockError;
use firmware::link::{Hello, PROTOCOL_VERSION, Refusal, Source, schema};

/// Why a conversation with the board does not come about, or ends.
#[derive(Debug, thiserror::Error)]
pub enum LinkError {
    /// No port was named, and none was found at USB.
    #[error("no USB serial port was found{}", also(.others))]
    NoPort {
        /// Ports of other kinds, which can be named.
        others: Vec<String>,
    },
    /// No port was named, and the system cannot list them.
    #[error("the serial ports cannot be listed: {0}")]
    Ports(std::io::Error),
    /// No port was named, and there is more than one.
    #[error("{} serial ports were found: {}", .0.len(), .0.join(", "))]
    ManyPorts(Vec<String>),
    /// The port cannot be opened.
    #[error("{port}: cannot be opened: {source}")]
    Open {
        /// The port.
        port: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// Reading or writing failed.
    #[error("{port}: the line failed: {source}")]
    Line {
        /// The port.
        port: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// Nothing that is an answer has come.
    #[error("{port}: no answer to {what}, sent {attempts} times in {waited_s:.1} s{}", seen(*.bytes))]
    NoAnswer {
        /// The port.
        port: String,
        /// What was asked.
        what: &'static str,
        /// How often.
        attempts: u32,
        /// For how long [s].
        waited_s: f64,
        /// Bytes that came, and were no answer.
        bytes: u64,
    },
    /// The board speaks another version of the protocol.
    #[error(
        "the board ({}, build {}) speaks version {} of the protocol, this tool version \
         {PROTOCOL_VERSION}: the {} is older",
        .0.board.as_str(), .0.build_id.as_str(), .0.protocol_version, older(.0)
    )]
    ProtocolMismatch(Box<Hello>),
    /// The board's messages have other types.
    #[error(
        "the board ({}, build {}) has messages of another build ({:08X}) than this tool \
         (build {}, {:08X})",
        .0.board.as_str(), .0.build_id.as_str(), .0.schema_hash, firmware::link::BUILD_ID,
        schema::HASH
    )]
    SchemaMismatch(Box<Hello>),
    /// The board refused.
    #[error("{what}: {why}")]
    Refused {
        /// What was asked.
        what: &'static str,
        /// The board's reason.
        why: Box<Refusal>,
    },
    /// The board answers, but sends no telemetry.
    #[error("the board sends no telemetry, waited {waited_s:.1} s")]
    NoTelemetry {
        /// How long was waited [s].
        waited_s: f64,
    },
    /// The arm does not come to rest.
    #[error("joint {joint} is not at rest: it moved by {moved_rad:.4} rad, waited {waited_s:.0} s")]
    NotAtRest {
        /// The joint, 1 to 3.
        joint: u8,
        /// How far it went within 0.2 s [rad].
        moved_rad: f64,
        /// How long was waited [s].
        waited_s: f64,
    },
    /// An answer of another kind than the request's.
    #[error("the board's answer to {0} is of another kind")]
    UnexpectedAnswer(&'static str),
    /// A block that cannot be sent.
    #[error("the parameter block: {0}")]
    Encode(BlockError),
    /// The board's block cannot be read.
    #[error("the board's block: {0}")]
    Decode(BlockError),
    /// A downloaded block is not the one that the board announced.
    #[error("the block came with CRC-32C {found:08X}, the board announced {announced:08X}")]
    Checksum {
        /// Of the bytes that came.
        found: u32,
        /// As the board announced.
        announced: u32,
    },
    /// What is on the board is not what was sent.
    #[error("what was read back ({which:?}) differs from what was sent at byte {offset}")]
    ReadBack {
        /// Which of the board's blocks.
        which: Source,
        /// The first byte that differs.
        offset: usize,
    },
}

fn also(others: &[String]) -> String {
    match others {
        [] => String::new(),
        others => format!("; others are: {}", others.join(", ")),
    }
}

fn seen(bytes: u64) -> String {
    match bytes {
        0 => String::new(),
        bytes => format!("; {bytes} bytes came that are no answer"),
    }
}

fn older(board: &Hello) -> &'static str {
    if board.protocol_version < PROTOCOL_VERSION { "firmware" } else { "tool" }
}
