//! `cargo xtask setup`: all that building and emulating the firmware needs.

use anyhow::Result;

use crate::command::find_program;
use crate::packages;
use crate::toolchain::FirmwareToolchain;

/// Finds or makes the firmware's toolchain and its emulator.
pub fn run() -> Result<()> {
    FirmwareToolchain::find_or_make()?;
    ensure_emulator()
}

/// QEMU for Arm, which plays the board in the end-to-end tests and in the demo.
pub fn ensure_emulator() -> Result<()> {
    match find_program("qemu-system-arm") {
        Some(_) => Ok(()),
        None => packages::ensure(&["qemu-system-arm"]),
    }
}
