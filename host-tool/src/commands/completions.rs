//! `rrr completions`: what a shell needs to complete `rrr`'s command line.

use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};

use super::output::say;
use super::{CommandLine, Failure};

/// Arguments of `rrr completions`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The shell.
    #[arg(value_enum, value_name = "SHELL")]
    pub shell: Shell,
}

/// Runs the command: the script goes to the standard output.
///
/// # Errors
/// The output does not take it.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut script = Vec::new();
    generate(arguments.shell, &mut CommandLine::command(), "rrr", &mut script);
    say(String::from_utf8_lossy(&script).trim_end())
}
