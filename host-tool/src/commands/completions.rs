//! `rrr completions`: what a shell needs to complete `rrr`'s command line.

use clap::{Args, Command};
use clap_complete::{Shell, generate};
use serde_json::json;

use crate::failure::Failure;
use crate::terminal::answer::answer;
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
    let script = String::from_utf8_lossy(&script);
    print_line(script.trim_end())?;
    answer(&json!({ "shell": arguments.shell.to_string(), "script": script }))
}
