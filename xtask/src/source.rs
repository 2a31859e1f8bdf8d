//! `cargo xtask imports` and `cargo xtask lengths`: what the source itself tells.

use anyhow::Result;

use crate::command::{cargo, run as run_command};

/// Runs a check on the workspace in a directory, or on this one. It is a program of its
/// own, so that the other tasks do not wait for its parser of Rust.
pub fn run(check: &str, directory: &[&str]) -> Result<()> {
    let mut checks = cargo("run");
    checks.args(["--quiet", "--profile", "chores", "--package", "source-checks", "--", check]);
    for directory in directory {
        checks.arg(std::path::absolute(directory)?);
    }
    run_command(&mut checks)
}
