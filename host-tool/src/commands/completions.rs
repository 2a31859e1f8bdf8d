//! `rrr completions`: what a shell needs to complete `rrr`'s command line.

use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};

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
/// None.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut script = Vec::new();
    generate(arguments.shell, &mut CommandLine::command(), "rrr", &mut script);
    print!("{}", String::from_utf8_lossy(&script));
    Ok(())
}
