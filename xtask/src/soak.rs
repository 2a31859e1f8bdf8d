//! `cargo xtask soak`: a day of the whole board above its pins, at a noisy line.

use anyhow::{Result, bail};

use crate::command::{cargo, run as run_command};

/// Runs `--hours` of simulated time, 24 without.
pub fn run(arguments: &[&str]) -> Result<()> {
    let hours = match arguments {
        [] => "24",
        ["--hours", hours] if hours.parse::<f64>().is_ok_and(|h| h > 0.0) => hours,
        _ => bail!("soak takes `--hours` and a number above 0, not `{}`", arguments.join(" ")),
    };
    let mut soak = cargo("run");
    soak.args(["--quiet", "--release", "-p", "tests", "--example", "soak", "--", hours]);
    run_command(&mut soak)
}
