//! The host tool: records, identifies, simulates and diagnoses the RRR robot.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`files`] | logs, data sets and models, as they lie on disk |
//! | [`commands`] | one file per subcommand of `rrr` |
#![forbid(unsafe_code)]

pub mod commands;
pub mod files;
