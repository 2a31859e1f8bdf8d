//! The project's chores, called as `cargo xtask <task>`.

mod board;
mod command;
mod firmware;
mod image;
mod lint;
mod packages;
mod setup;
mod toolchain;
mod workspace;

use std::process::ExitCode;

use anyhow::{Result, bail};

const HELP: &str = "\
The project's chores: cargo xtask <task>

  setup                    find or make all that the firmware and its emulator need
  firmware [qemu|nucleo]   build the images, print their paths and sizes, check the limits
  lint                     formatting and clippy, on the host and for every board";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments.iter().map(String::as_str).collect::<Vec<_>>()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[&str]) -> Result<()> {
    match arguments {
        [] | ["help" | "--help" | "-h"] => println!("{HELP}"),
        ["lint"] => lint::run()?,
        ["setup"] => setup::run()?,
        ["firmware", boards @ ..] => firmware::run(boards)?,
        [task, ..] => bail!("`{task}` is no task, or not with these arguments\n\n{HELP}"),
    }
    Ok(())
}
