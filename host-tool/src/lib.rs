//! The host tool: records, identifies, simulates and diagnoses the RRR robot.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`files`] | logs, data sets and models, as they lie on disk |
//! | [`board`] | the control firmware, in this process or in QEMU |
//! | [`simulation`] | the simulated robot, and experiments recorded with it |
//! | [`report`] | pages with pictures |
//! | [`commands`] | one file per subcommand of `rrr` |
#![forbid(unsafe_code)]

pub mod board;
pub mod commands;
pub mod files;
pub mod progress;
pub mod report;
pub mod simulation;
