//! `rrr clear-fault`: out of a fault whose cause is gone.

use firmware::link::Command;

use super::Failure;
pub use super::link_choice::LinkChoice as Arguments;
use super::output::say;

/// Runs the command.
///
/// # Errors
/// A board that does not answer, or a fault whose cause is still there.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut client = arguments.connect()?;
    match client.report()?.fault {
        Some(fault) => {
            client.order(Command::ClearFault)?;
            say(format_args!("cleared: {fault}"))?;
        }
        None => say("there is no fault")?,
    }
    say(format_args!("the board is {}", client.report()?.state))
}
