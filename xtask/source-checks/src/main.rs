//! What the source itself tells: `source-checks imports|lengths [DIRECTORY]`.
//!
//! `cargo xtask imports` and `cargo xtask lengths` call it.

mod crates;
mod imports;
mod lengths;
mod syntax;

use std::path::Path;
use std::process::ExitCode;

use anyhow::{Result, bail};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("source-checks: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[&str]) -> Result<()> {
    let directory = Path::new(arguments.get(1).unwrap_or(&"."));
    match arguments {
        ["imports"] | ["imports", _] => imports::run(directory),
        ["lengths"] | ["lengths", _] => lengths::run(directory),
        _ => bail!("say `imports` or `lengths`, and the workspace's directory if it is another"),
    }
}
