//! `cargo xtask demo`: the host tool against the firmware on the emulated board.

use anyhow::Result;

use crate::board::Board;
use crate::command::{cargo, run as run_command, run_beside, say};
use crate::emulator;
use crate::firmware;
use crate::toolchain::FirmwareToolchain;
use crate::workspace;

/// Builds the image and the host tool, and leaves the demo's results in `target/demo`.
pub fn run() -> Result<()> {
    let toolchain = FirmwareToolchain::find_or_make()?;
    emulator::ensure()?;
    say("building the host tool and the image");
    let rrr = ["--quiet", "--release", "--package", "host-tool", "--bin", "rrr"];
    let image = run_beside(cargo("build").args(rrr), || firmware::build(&toolchain, Board::Qemu))?;
    say("running `rrr demo`");
    let mut demo = cargo("run");
    demo.args(rrr).args(["--", "demo", "--firmware"]).arg(image.path());
    run_command(demo.arg("--out").arg(workspace::target_dir().join("demo")))
}
