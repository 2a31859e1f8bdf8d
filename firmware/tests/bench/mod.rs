//! A board's end of the line, and a host of few words.

pub mod memory_store;
pub mod operator;
