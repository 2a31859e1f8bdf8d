//! How the host reaches the board: its serial line, as `firmware::link` describes it, and its
//! debug probe.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`address`], [`port`] | where the board is: a serial port, TCP, a socket or a pty |
//! | [`connection`], [`client`], [`reply`] | frames, time-outs, retries; numbered requests, the key; replies |
//! | [`transfer`] | parameter blocks up, down, and compared |
//! | [`run`], [`approach`] | a run from arming to disarming, and the motion to where it begins |
//! | [`settling`], [`stop`] | waiting until the arm rests, stopping it |
//! | [`recorder`], [`tick_range`] | telemetry to a log, and which ticks are missing |
//! | [`flash_image`] | what goes into the board's flash, and what may |

#![forbid(unsafe_code)]

pub mod address;
pub mod approach;
pub mod client;
pub mod connection;
pub mod error;
pub mod flash_image;
pub mod port;
pub mod recorder;
pub mod reply;
pub mod run;
pub mod settling;
pub mod stop;
pub mod tick_range;
pub mod transfer;

pub use address::Address;
pub use client::Client;
pub use connection::{LineCounters, RetryPolicy};
pub use error::LinkError;
pub use recorder::Recorder;
pub use reply::OwnedReply;
