//! The terminal: lines on the standard output, progress, Ctrl-C.

pub mod answer;
pub mod interrupt;
pub mod json_mode;
pub mod output;
pub mod progress;
mod say;
