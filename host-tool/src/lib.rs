//! The command `rrr`; what it stands on has a crate for each floor beside it.
#![forbid(unsafe_code)]

pub mod commands;
pub mod progress;
