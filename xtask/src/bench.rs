//! `cargo xtask bench`: the benchmarks of all packages.

use anyhow::Result;

use crate::command::{cargo, run as run_command};

/// Runs them all, or those whose names contain the filter.
pub fn run(filter: &[&str]) -> Result<()> {
    let mut bench = cargo("bench");
    run_command(bench.args(["--workspace", "--bench", "*", "--"]).args(filter))
}
