//! `rrr clear-fault`: out of a fault whose cause is gone.

use firmware::link::Command;

use crate::failure::Failure;
pub use crate::options::board::BoardOptions as Arguments;
use crate::terminal::answer::answer;
use crate::terminal::output::print_line;
use serde_json::json;

/// Runs the command.
///
/// # Errors
/// A board that does not answer, or a fault whose cause is still there.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut client = arguments.connect()?;
    match client.report()?.fault {
        Some(fault) => {
            client.execute(Command::ClearFault)?;
            print_line(format_args!("cleared: {fault}"))?;
        }
        None => print_line("there is no fault")?,
    }
    let state = client.report()?.state;
    print_line(format_args!("the board is {state}"))?;
    answer(&json!({ "state": state.to_string() }))
}
