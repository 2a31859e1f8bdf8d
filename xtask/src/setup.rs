//! `cargo xtask setup`: all that building and emulating the firmware needs.

use anyhow::Result;

use crate::emulator;
use crate::toolchain::FirmwareToolchain;

/// Finds or makes the firmware's toolchain and its emulator.
pub fn run() -> Result<()> {
    FirmwareToolchain::find_or_make()?;
    emulator::ensure()
}
