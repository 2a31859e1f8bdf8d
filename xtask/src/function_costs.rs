//! `cargo xtask function-costs`: what elementary functions cost on the board's core.

use anyhow::Result;

use crate::emulator;
use crate::firmware;
use crate::toolchain::FirmwareToolchain;

/// The image that measures them; its feature has the same name.
pub const BINARY: &str = "qemu-function-costs";

/// Builds the measuring image and runs it, which prints the table.
pub fn run() -> Result<()> {
    let toolchain = FirmwareToolchain::find_or_make()?;
    emulator::ensure()?;
    emulator::run(&firmware::build_binary(&toolchain, BINARY)?)
}
