//! Command-line options that several subcommands have, and what is made of them.

pub mod block;
pub mod board;
pub mod compensation;
pub mod effects;
pub mod foxglove;
pub mod key_file;
pub mod mode;
pub mod number;
pub mod slot;
