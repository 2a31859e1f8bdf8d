//! The NUCLEO-G474RE, emulated: the firmware's release image executed from its reset on, with
//! models of the registers that it touches, the converter and the arm around it.
//!
//! For tests alone: it links Unicorn, which is under the GPL. `docs/emulator.md` tells what is
//! modelled and what is not.
#![forbid(unsafe_code)]

pub mod advance;
pub mod board;
mod bus;
pub mod converter;
pub mod core;
mod engine;
pub mod failure;
pub mod handler;
pub mod image;
mod injection;
pub mod loopback;
pub mod machine;
pub mod memory_map;
pub mod operator;
pub mod plant;
mod ram;
pub mod registers;
pub mod replica;
pub mod tcp_line;
pub mod trace;
