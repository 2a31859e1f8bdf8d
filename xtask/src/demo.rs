//! `cargo xtask demo`: the host tool against the firmware on the emulated board.

use anyhow::Result;

use crate::board::Board;
use crate::command::{cargo, run as run_command, say};
use crate::emulator;
use crate::firmware;
use crate::toolchain::FirmwareToolchain;
use crate::workspace;

/// Builds the image and the host tool, and leaves the demo's results in `target/demo`.
pub fn run() -> Result<()> {
    let toolchain = FirmwareToolchain::find_or_make()?;
    emulator::ensure()?;
    let image = firmware::build(&toolchain, Board::Qemu)?;
    say("building the host tool and running `rrr demo`");
    let mut rrr = cargo("run");
    rrr.args(["--quiet", "--release", "--package", "host-tool", "--bin", "rrr", "--"]);
    rrr.arg("demo").arg("--firmware").arg(image.path());
    run_command(rrr.arg("--out").arg(workspace::target_dir().join("demo")))
}
