//! `cargo xtask test`: every test there is, the emulated board's included.

use anyhow::Result;

use crate::board::Board;
use crate::check_elf;
use crate::command::{cargo, run as run_command, say};
use crate::emulator;
use crate::firmware;
use crate::image::Image;
use crate::toolchain::FirmwareToolchain;

/// Builds, weighs and checks the images, then runs the tests of all packages.
pub fn run() -> Result<()> {
    let toolchain = FirmwareToolchain::find_or_make()?;
    emulator::ensure()?;
    let image = build_and_check(&toolchain, Board::Qemu)?;
    build_and_check(&toolchain, Board::Nucleo)?;
    say("running the tests of all packages");
    let mut test = cargo("test");
    test.args(["--quiet", "--release", "--workspace"]);
    run_command(test.env(emulator::IMAGE_VARIABLE, image.path()))
}

fn build_and_check(toolchain: &FirmwareToolchain, board: Board) -> Result<Image> {
    let image = firmware::build_and_weigh(toolchain, board)?;
    check_elf::check(board, &image)?;
    Ok(image)
}
