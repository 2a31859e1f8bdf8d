//! `cargo xtask test`: every test there is, the emulated board's included.

use anyhow::Result;

use crate::board::Board;
use crate::check_elf;
use crate::command::{cargo, run as run_command, say};
use crate::firmware;
use crate::image::Image;
use crate::setup;
use crate::toolchain::FirmwareToolchain;

/// Tells the end-to-end tests which image to run.
const QEMU_FIRMWARE: &str = "RRR_QEMU_FIRMWARE";

/// Builds, weighs and checks the images, then runs the tests of all packages.
pub fn run() -> Result<()> {
    let toolchain = FirmwareToolchain::find_or_make()?;
    setup::ensure_emulator()?;
    let image = build_and_check(&toolchain, Board::Qemu)?;
    build_and_check(&toolchain, Board::Nucleo)?;
    say("running the tests of all packages");
    run_command(cargo("test").args(["--quiet", "--workspace"]).env(QEMU_FIRMWARE, image.path()))
}

fn build_and_check(toolchain: &FirmwareToolchain, board: Board) -> Result<Image> {
    let image = firmware::build_and_weigh(toolchain, board)?;
    check_elf::check(board, &image)?;
    Ok(image)
}
