//! `rrr stop`: 0 V now, and disarmed.

use super::Failure;
pub use super::link_choice::LinkChoice as Arguments;
use super::output::say;
use link::session::halt;

/// Runs the command; it needs no key, and looks at none.
///
/// # Errors
/// A board that does not answer.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let state = halt(&mut arguments.connect_to_stop()?)?;
    say(format_args!("the board is {state}"))
}
