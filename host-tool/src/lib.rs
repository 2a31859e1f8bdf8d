//! The command `rrr`; the crates beside it hold what its subcommands call.
#![forbid(unsafe_code)]

pub mod commands;
pub mod failure;
pub mod live;
pub mod options;
pub mod output_files;
pub mod provenance;
pub mod terminal;
