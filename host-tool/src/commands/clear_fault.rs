//! `rrr clear-fault`: out of a fault whose cause is gone.

use clap::Args;
use firmware::link::Command;

use super::Failure;
use super::link_choice::LinkChoice;

/// Arguments of `rrr clear-fault`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Which board.
    #[command(flatten)]
    pub link: LinkChoice,
}

/// Runs the command.
///
/// # Errors
/// A board that does not answer, or a fault whose cause is still there.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut client = arguments.link.connect()?;
    match client.report()?.fault {
        Some(fault) => {
            client.order(Command::ClearFault)?;
            println!("cleared: {fault}");
        }
        None => println!("there is no fault"),
    }
    println!("the board is {}", client.report()?.state);
    Ok(())
}
