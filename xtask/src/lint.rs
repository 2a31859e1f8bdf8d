//! `cargo xtask lint`: formatting and clippy, on the host and for every board.

use anyhow::Result;

use crate::board::Board;
use crate::command::{cargo, run as run_command, say};
use crate::firmware;
use crate::toolchain::FirmwareToolchain;

/// Fails at the first file that is not formatted and at every warning.
pub fn run() -> Result<()> {
    say("checking the formatting");
    run_command(cargo("fmt").args(["--all", "--check"]))?;
    say("clippy for the host");
    let mut host = cargo("clippy");
    host.args(["--quiet", "--workspace", "--all-targets"]);
    run_command(host.args(["--", "-D", "warnings"]))?;
    let toolchain = FirmwareToolchain::find_or_make()?;
    Board::ALL.into_iter().try_for_each(|board| lint_board(&toolchain, board))
}

fn lint_board(toolchain: &FirmwareToolchain, board: Board) -> Result<()> {
    say(format!("clippy for {}", board.name()));
    let mut clippy = toolchain.clippy();
    clippy.arg("--quiet").args(firmware::package_arguments(board));
    run_command(clippy.args(["--", "-D", "warnings"]))
}
