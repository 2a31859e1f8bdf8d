//! What goes between host and board: one definition for both ends.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`request`], [`answer`], [`telemetry`] | the messages' types |
//! | [`hello`], [`schema`] | how two builds detect that their messages differ |
//! | [`messages`], [`checked`] | messages to frames with a checksum, and back |
//! | [`handler`], [`upload`] | the board's end: bytes in, answers out |
//! | [`supervisor_access`], [`block_store`] | what the handler works on: the supervisor and the store |
//! | [`boot_state`] | what a boot finds in the store |
//! | [`outbox`], [`board_runtime`] | the send buffer; supervisor, handler and outbox in one thread |
//! | [`key`] | authentication of requests with a shared key |
//!
//! A conversation: Hello, answered by the board's Hello; `Challenge` where the board
//! has a key; requests one at a time, each sent again, unchanged, until it is answered.
//! Telemetry comes in between, once `Stream` has asked for it.

pub mod answer;
pub mod block_store;
pub mod board_runtime;
pub mod boot_state;
pub mod checked;
mod commands;
mod conversation;
mod display;
pub mod handler;
pub mod hello;
pub mod key;
pub mod messages;
pub mod outbox;
mod refusals;
pub mod request;
pub mod schema;
pub mod supervisor_access;
pub mod telemetry;
pub mod upload;

pub use answer::{
    Answer, BlockRefusal, Counters, Origin, Parameters, Refusal, Reply, Report, StoreRefusal,
};
pub use block_store::BlockStore;
pub use board_runtime::BoardRuntime;
pub use boot_state::BootState;
pub use checked::MAX_FRAME_BYTES;
pub use conversation::HandlerConfig;
pub use handler::Handler;
pub use hello::{BUILD_ID, Hello, PROTOCOL_VERSION};
pub use key::{Key, Nonce, Proof};
pub use messages::{FrameError, ToBoard, ToHost};
pub use request::{Command, PIECE_BYTES, Request, Source};
pub use supervisor_access::{SupervisorAccess, SupervisorStatus};
pub use telemetry::Telemetry;

/// Speed of the serial line [baud], 8 data bits, no parity, one stop bit.
pub const BAUD: u32 = 921_600;
