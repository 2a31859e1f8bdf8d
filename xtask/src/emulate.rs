//! `cargo xtask emulate`: the NUCLEO's image on an emulated board, for tests and to connect to.

use std::path::PathBuf;
use std::process::Command;

use anyhow::{Result, bail};

use crate::board::Board;
use crate::command::{cargo, run as run_command, say};
use crate::firmware;
use crate::image::Image;
use crate::packages;
use crate::toolchain::FirmwareToolchain;
use crate::workspace;

/// What building the engine takes beside a compiler.
const PACKAGES: [&str; 3] = ["cmake", "make", "libclang-dev"];
/// What the emulator's tests are told: the image, the host tool, and to take their time.
const IMAGE_VARIABLE: &str = "RRR_NUCLEO_FIRMWARE";
const TOOL_VARIABLE: &str = "RRR_TOOL";
const SOAK_VARIABLE: &str = "RRR_SOAK";
const HOURS_VARIABLE: &str = "RRR_SOAK_HOURS";
const TICKS_VARIABLE: &str = "RRR_TICKS";

/// With `--soak` the tests at their full length, with `--soak --hours` sessions for so long, with `--ticks` what the tick takes, else the image at a port with these arguments.
pub fn run(arguments: &[&str]) -> Result<()> {
    let toolchain = FirmwareToolchain::find_or_make()?;
    let image = firmware::build(&toolchain, Board::Nucleo)?;
    if let ["--soak"] = arguments {
        run_command(cargo("build").args(["--quiet", "--release", "--package", "host-tool"]))?;
        return run_tests(&image, true);
    }
    if let ["--soak", "--hours", hours] = arguments {
        return run_sessions(&image, hours);
    }
    if let ["--ticks"] = arguments {
        return tell_ticks(&image);
    }
    packages::ensure(&PACKAGES)?;
    let mut emulator = emulator("run");
    emulator.args(["--", "--image"]).arg(image.path()).args(arguments);
    run_command(&mut emulator)
}

/// The short tests; the host tool has been built.
pub fn test(image: &Image) -> Result<()> {
    run_tests(image, false)
}

/// Sessions that end in every way, for so many hours of the board.
fn run_sessions(image: &Image, hours: &str) -> Result<()> {
    if !hours.parse::<f64>().is_ok_and(|hours| hours > 0.0) {
        bail!("--hours takes a number above 0, not `{hours}`");
    }
    packages::ensure(&PACKAGES)?;
    let mut test = emulator("test");
    test.env(IMAGE_VARIABLE, image.path()).env(HOURS_VARIABLE, hours);
    run_command(test.args(["--test", "soak", "--", "--nocapture"]))
}

/// Prints what the tick takes in each reference and mode.
fn tell_ticks(image: &Image) -> Result<()> {
    packages::ensure(&PACKAGES)?;
    let mut test = emulator("test");
    test.env(IMAGE_VARIABLE, image.path()).env(TICKS_VARIABLE, "1");
    run_command(test.args(["--test", "ticks", "--", "--nocapture"]))
}

fn run_tests(image: &Image, soak: bool) -> Result<()> {
    packages::ensure(&PACKAGES)?;
    say("running the tests of the emulated NUCLEO");
    let mut test = emulator("test");
    test.env(IMAGE_VARIABLE, image.path()).env(TOOL_VARIABLE, tool());
    if soak {
        test.env(SOAK_VARIABLE, "1").args(["--", "--nocapture", "--test-threads", "1"]);
    }
    run_command(&mut test)
}

fn tool() -> PathBuf {
    workspace::target_dir().join("release").join("rrr")
}

/// A cargo command in the emulator's own workspace, which builds beside the others.
fn emulator(subcommand: &str) -> Command {
    let mut command = cargo(subcommand);
    command.args(["--quiet", "--release", "--manifest-path", "emulator/Cargo.toml"]);
    command.env("CARGO_TARGET_DIR", workspace::target_dir());
    command
}

/// Formatting and clippy of the emulator.
pub fn lint() -> Result<()> {
    packages::ensure(&PACKAGES)?;
    run_command(cargo("fmt").args(["--manifest-path", "emulator/Cargo.toml", "--check"]))?;
    let mut clippy = emulator("clippy");
    run_command(clippy.args(["--all-targets", "--", "-D", "warnings"]))
}
