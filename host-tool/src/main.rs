//! The command line of the host tool.

use std::io::Write;
use std::process::ExitCode;

use clap::Parser;
use host_tool::commands::CommandLine;
use host_tool::failure::Failure;
use host_tool::terminal::answer::answer_failure;
use host_tool::terminal::json_mode::wanted_as_json;

fn main() -> ExitCode {
    let CommandLine { json, command } = match CommandLine::try_parse() {
        Ok(line) => line,
        Err(error) => refuse(&error),
    };
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

/// Ends the program over a command line that cannot be used, or with the help that it asks for.
fn refuse(error: &clap::Error) -> ! {
    let is_json = std::env::args_os().any(|word| word == "--json");
    if is_json && error.use_stderr() {
        wanted_as_json(true);
        let text = error.to_string();
        let message = text.trim_start_matches("error: ").split("\n\n").next().unwrap_or_default();
        answer_failure(&Failure::new(
            message,
            "`rrr help` and `rrr help COMMAND` tell what there is",
        ));
    }
    error.exit()
}
