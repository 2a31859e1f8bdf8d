//! What goes between host and board: one definition for both ends.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`request`], [`answer`], [`telemetry`] | the messages' types |
//! | [`hello`], [`schema`] | how two builds find out that they do not fit |
//! | [`messages`], [`checked`] | messages to frames with a checksum, and back |
//! | [`handler`], [`upload`] | the board's end: bytes in, answers out |
//! | [`desk`] | what the handler works on: the supervisor and the store |
//! | [`kept`] | the store in flash, as the handler wants it |
//! | [`outbox`], [`station`] | what waits to be sent; all of it in one thread |
//! | [`key`] | the proof that a request comes from somebody with the key |
//!
//! A conversation: Hello, answered by the board's Hello; `Challenge` where the board
//! has a key; requests one at a time, each sent again, unchanged, until it is answered.
//! Telemetry comes in between, once `Stream` has asked for it.

pub mod answer;
pub mod checked;
mod commands;
pub mod desk;
pub mod handler;
pub mod hello;
pub mod kept;
pub mod key;
pub mod messages;
pub mod outbox;
pub mod request;
pub mod schema;
pub mod station;
pub mod telemetry;
pub mod upload;
mod words;

pub use answer::{
    Answer, BlockRefusal, Counters, Origin, Parameters, Refusal, Reply, Report, StoreRefusal,
};
pub use checked::MAX_FRAME_BYTES;
pub use desk::{BlockStore, Desk, Standing};
pub use handler::{Beginning, Handler};
pub use hello::{Hello, PROTOCOL_VERSION};
pub use kept::Kept;
pub use key::{Key, Nonce, Proof};
pub use messages::{FrameError, ToBoard, ToHost};
pub use request::{Command, PIECE_BYTES, Request, Source};
pub use station::Station;
pub use telemetry::Telemetry;

/// Which build of the firmware this is.
pub const BUILD_ID: &str = match option_env!("RRR_BUILD_ID") {
    Some(id) => id,
    None => env!("CARGO_PKG_VERSION"),
};
/// Speed of the serial line [baud], 8 data bits, no parity, one stop bit.
pub const BAUD: u32 = 921_600;
