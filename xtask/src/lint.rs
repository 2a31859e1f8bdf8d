//! `cargo xtask lint`: imports, formatting and clippy, on the host and for every image.

use anyhow::Result;

use crate::board::Board;
use crate::command::{cargo, run as run_command, say};
use crate::emulate;
use crate::firmware;
use crate::function_costs;
use crate::source;
use crate::toolchain::FirmwareToolchain;

/// Fails at circles of imports, at files that are not formatted and at every warning.
pub fn run() -> Result<()> {
    say("looking for circles of imports");
    source::run("imports", &[])?;
    source::run("imports", &["emulator"])?;
    say("checking the formatting");
    run_command(cargo("fmt").args(["--all", "--check"]))?;
    say("clippy for the host");
    lint_host(&["--workspace"])?;
    say("clippy for the host tool with a debug probe");
    lint_host(&["--package", "link", "--package", "host-tool", "--features", "probe"])?;
    say("formatting and clippy of the emulator");
    emulate::lint()?;
    let toolchain = FirmwareToolchain::find_or_make()?;
    let boards = Board::ALL.map(Board::binary);
    let mut binaries = boards.into_iter().chain([function_costs::BINARY]);
    binaries.try_for_each(|binary| lint_firmware(&toolchain, binary))
}

fn lint_host(packages: &[&str]) -> Result<()> {
    let mut clippy = cargo("clippy");
    clippy.args(["--quiet", "--all-targets"]).args(packages);
    run_command(clippy.args(["--", "-D", "warnings"]))
}

fn lint_firmware(toolchain: &FirmwareToolchain, binary: &str) -> Result<()> {
    say(format!("clippy for the firmware {binary}"));
    let mut clippy = toolchain.clippy();
    clippy.arg("--quiet").args(firmware::package_arguments(binary));
    run_command(clippy.args(["--", "-D", "warnings"]))
}
