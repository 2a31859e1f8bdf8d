//! `cargo xtask fuzz`: damaged inputs for all that takes bytes from outside.

use anyhow::Result;

use crate::command::{cargo, run as run_command};

/// Runs the plain runner: a target or all, `--runs N`, `--seed N`.
pub fn run(arguments: &[&str]) -> Result<()> {
    let mut fuzz = cargo("run");
    fuzz.args(["--quiet", "--release", "--package", "fuzz-entries", "--"]);
    match arguments {
        [] => fuzz.arg("all"),
        [option, ..] if option.starts_with("--") => fuzz.arg("all").args(arguments),
        _ => fuzz.args(arguments),
    };
    run_command(&mut fuzz)
}
