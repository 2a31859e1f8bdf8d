//! The compiler and the core library for the firmware's target.
//!
//! Three ways, the first that works: rustup has the target; rustup can fetch it;
//! Debian's compiler of the web browsers, with a core library built once for it.

mod debian;
mod rustup;
mod sysroot;
mod target;

use std::env;
use std::path::PathBuf;
use std::process::Command;

use anyhow::Result;

use crate::command::cargo;
use crate::workspace;

pub use target::TARGET;

/// Set to `debian` to do without rustup's target even where it is to be had.
const CHOICE: &str = "RRR_FIRMWARE_TOOLCHAIN";

/// A toolchain that can build the firmware.
pub struct FirmwareToolchain {
    /// Debian's sysroot; none when the host's own toolchain has the target.
    sysroot: Option<PathBuf>,
}

impl FirmwareToolchain {
    /// Finds a toolchain, or installs one and says so; quick and silent once it is there.
    pub fn find_or_make() -> Result<Self> {
        let debian_only = env::var_os(CHOICE).is_some_and(|choice| choice == "debian");
        if !debian_only && rustup::has_target() {
            return Ok(Self { sysroot: None });
        }
        if let Some(sysroot) = debian::existing_sysroot()? {
            return Ok(Self { sysroot: Some(sysroot) });
        }
        if !debian_only && rustup::add_target() {
            return Ok(Self { sysroot: None });
        }
        Ok(Self { sysroot: Some(debian::make_sysroot()?) })
    }

    /// A cargo command that compiles for the board into the firmware's own directory.
    pub fn cargo(&self, subcommand: &str) -> Command {
        let mut command = cargo(subcommand);
        self.configure(&mut command);
        command
    }

    /// `cargo clippy` for the board.
    pub fn clippy(&self) -> Command {
        let Some(sysroot) = &self.sysroot else { return self.cargo("clippy") };
        let mut command = Command::new(debian::CARGO_CLIPPY);
        command.arg("clippy").env("SYSROOT", sysroot).current_dir(workspace::root());
        self.configure(&mut command);
        command
    }

    fn configure(&self, command: &mut Command) {
        command.args(["--target", TARGET]);
        command.env("CARGO_TARGET_DIR", workspace::firmware_target_dir());
        if let Some(sysroot) = &self.sysroot {
            command.env("RUSTC", sysroot::rustc(sysroot));
        }
    }
}
