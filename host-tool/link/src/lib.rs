//! The host's ways to the board: its serial line, as `firmware::link` describes it, and its
//! debug probe.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`address`], [`port`] | where the board is: a serial port, TCP, a socket or a pty |
//! | [`client`], [`told`] | numbered requests, time-outs, retries, the key; answers |
//! | [`transfer`] | parameter blocks up, down, and compared |
//! | [`session`], [`approach`] | a run from arming to disarming, and the way to its beginning |
//! | [`recorder`], [`span`] | telemetry to a log, and which ticks are missing |
//! | [`flash_image`] | what goes into the board's flash, and what may |

#![forbid(unsafe_code)]

pub mod address;
pub mod approach;
pub mod client;
pub mod error;
pub mod flash_image;
pub mod port;
pub mod recorder;
pub mod session;
pub mod span;
pub mod told;
pub mod transfer;

pub use address::Address;
pub use client::{Client, Patience, Tally};
pub use error::LinkError;
pub use recorder::Recorder;
pub use told::Told;
