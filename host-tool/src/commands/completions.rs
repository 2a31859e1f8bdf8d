//! `rrr completions`: what a shell needs to complete `rrr`'s command line.

use clap::{Args, Command};
use clap_complete::{Shell, generate};

use crate::failure::Failure;
use crate::terminal::output::print_line;

/// Arguments of `rrr completions`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The shell.
    #[arg(value_enum, value_name = "SHELL")]
    pub shell: Shell,
}

/// Runs the command for the whole command line: the script goes to the standard output.
///
/// # Errors
/// The output does not take it.
pub fn run(arguments: &Arguments, command_line: &mut Command) -> Result<(), Failure> {
    let mut script = Vec::new();
    generate(arguments.shell, command_line, "rrr", &mut script);
    print_line(String::from_utf8_lossy(&script).trim_end())
}
