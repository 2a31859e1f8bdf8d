//! The command line of the host tool.

use std::io::Write;
use std::process::ExitCode;

use clap::Parser;
use host_tool::commands::CommandLine;
use host_tool::terminal::answer::answer_failure;
use host_tool::terminal::json_mode::wanted_as_json;

fn main() -> ExitCode {
    let CommandLine { json, command } = CommandLine::parse();
    wanted_as_json(json);
    match command.run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            answer_failure(&failure);
            // The terminal may be gone; the exit status still tells.
            let _ = writeln!(std::io::stderr(), "{}", failure.report());
            ExitCode::from(failure.status)
        }
    }
}
