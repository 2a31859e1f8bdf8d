//! `rrr stop`: 0 V now, and disarmed.

use crate::failure::Failure;
pub use crate::options::board::BoardOptions as Arguments;
use crate::terminal::answer::answer;
use crate::terminal::output::print_line;
use link::stop::stop_and_disarm;
use serde_json::json;

/// Runs the command; it needs no key, and looks at none.
///
/// # Errors
/// A board that does not answer.
pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let report = stop_and_disarm(&mut arguments.connect_without_key()?)?;
    print_line(format_args!("the board is {}", report.state))?;
    answer(&json!({ "state": report.state.to_string() }))
}
