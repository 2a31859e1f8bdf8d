//! The host's end of the board's serial line; `firmware::link` says what goes over it.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`address`], [`port`] | where the board is: a serial port, TCP, a socket or a pty |
//! | [`client`], [`told`] | numbered requests, time-outs, retries, the key; answers |
//! | [`transfer`] | parameter blocks up, down, and compared |
//! | [`session`], [`approach`] | a run from arming to disarming, and the way to its beginning |
//! | [`joints`] | which joints the rig has |
//! | [`recorder`], [`span`] | telemetry to a log, and which ticks are missing |
//! | [`simulated_board`] | a board in this process at a simulated robot, for tests |

pub mod address;
pub mod approach;
pub mod client;
pub mod error;
pub mod joints;
pub mod port;
pub mod recorder;
pub mod session;
pub mod simulated_board;
pub mod span;
pub mod told;
pub mod transfer;

pub use address::Address;
pub use client::{Client, Patience, Tally};
pub use error::LinkError;
pub use recorder::Recorder;
pub use told::Told;
