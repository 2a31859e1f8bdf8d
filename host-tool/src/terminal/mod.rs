//! The terminal: lines on the standard output, progress, Ctrl-C.

pub mod interrupt;
pub mod output;
pub mod progress;
