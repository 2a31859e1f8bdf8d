//! The command line of the host tool.

use std::io::Write;
use std::process::ExitCode;

use clap::Parser;
use host_tool::commands::CommandLine;

fn main() -> ExitCode {
    match CommandLine::parse().command.run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // The terminal may be gone; the exit status still tells.
            let _ = writeln!(std::io::stderr(), "{}", failure.report());
            ExitCode::from(failure.status)
        }
    }
}
