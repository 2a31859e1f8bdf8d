//! The command line of the host tool.

use std::io::Write;
use std::process::ExitCode;

use clap::Parser;
use host_tool::commands::CommandLine;

/// The exit status after bad input, of clap's as well.
const BAD_INPUT: u8 = 2;

fn main() -> ExitCode {
    match CommandLine::parse().command.run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // With nobody to read it, the exit status tells.
            let _ = writeln!(std::io::stderr(), "{}", failure.report());
            ExitCode::from(BAD_INPUT)
        }
    }
}
