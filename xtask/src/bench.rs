//! `cargo xtask bench`: the benchmarks of all packages.

use anyhow::Result;
use test_support::IMAGE_VARIABLE;

use crate::board::Board;
use crate::command::{cargo, run as run_command};
use crate::emulator;
use crate::firmware;
use crate::toolchain::FirmwareToolchain;

/// Runs them all, or those whose names contain the filter.
pub fn run(filter: &[&str]) -> Result<()> {
    let toolchain = FirmwareToolchain::find_or_make()?;
    emulator::ensure()?;
    let image = firmware::build(&toolchain, Board::Qemu)?;
    let mut bench = cargo("bench");
    bench.args(["--workspace", "--bench", "*", "--"]).args(filter);
    run_command(bench.env(IMAGE_VARIABLE, image.path()))
}
