//! Register models of what the image touches, one file per block (RM0440 names them so).
//!
//! A register or a value that is not here is refused, which ends the run.

pub mod adc;
pub mod dma;
pub mod flash;
pub mod gpio;
pub mod low_power_timer;
pub mod lpuart;
pub mod power;
pub mod random;
pub mod rcc;
pub mod spi;
pub mod timer;
pub mod timer_events;
pub mod watchdog;

use crate::failure::Refusal;

/// What an access comes to.
pub type Access<T> = Result<T, Refusal>;

/// Whether a block's interrupt line is up.
pub type Level = bool;

/// A point of time [cycles of 170 MHz since the first power-on].
pub type Time = u64;

/// Cycles in a second.
pub const CLOCK_HZ: u64 = 170_000_000;
/// Cycles in a millisecond.
pub const MS: u64 = CLOCK_HZ / 1000;
/// Cycles in a microsecond.
pub const US: u64 = CLOCK_HZ / 1_000_000;
