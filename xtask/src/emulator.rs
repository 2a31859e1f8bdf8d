//! QEMU for Arm, which plays the board in tests, benchmarks and the demo.

use std::process::Command;

use anyhow::Result;

use crate::command::{find_program, run as run_command};
use crate::image::Image;
use crate::packages;

const QEMU: &str = "qemu-system-arm";

/// Installs QEMU where it is missing.
pub fn ensure() -> Result<()> {
    match find_program(QEMU) {
        Some(_) => Ok(()),
        None => packages::ensure(&[QEMU]),
    }
}

/// Runs an image that ends by itself; an instruction takes 2^10 ns of its clock.
pub fn run(image: &Image) -> Result<()> {
    let mut qemu = Command::new(QEMU);
    qemu.args(["-M", "mps2-an386", "-nographic", "-monitor", "none", "-serial", "none"]);
    qemu.args(["-semihosting-config", "enable=on,target=native"]);
    qemu.args(["-icount", "shift=10,sleep=off"]);
    run_command(qemu.arg("-kernel").arg(image.path()))
}
