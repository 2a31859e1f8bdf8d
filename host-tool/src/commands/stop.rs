//! `rrr stop`: 0 V now, and disarmed.

use clap::Args;

use super::Failure;
use super::link_choice::LinkChoice;
use crate::link::session::halt;

/// Arguments of `rrr stop`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Which board; it needs no key to be stopped.
    #[command(flatten)]
    pub link: LinkChoice,
}

/// Runs the command.
///
/// # Errors
/// A board that does not answer.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let state = halt(&mut arguments.link.connect()?)?;
    println!("the board is {state}");
    Ok(())
}
