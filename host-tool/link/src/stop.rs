//! Stopping a board, whatever it does.

use firmware::link::{Command, Refusal, Report};

use super::client::Client;
use super::error::LinkError;

/// Outputs 0 V and disarms the board, whatever its state; its report afterwards.
///
/// # Errors
/// The line is broken or the board does not answer.
pub fn stop_and_disarm(client: &mut Client) -> Result<Report, LinkError> {
    for command in [Command::Stop, Command::Disarm] {
        match client.execute(command) {
            // Not running, not armed: that is what is wanted.
            Ok(()) => {}
            Err(LinkError::Refused { why, .. }) if matches!(*why, Refusal::NotNow { .. }) => {}
            Err(error) => return Err(error),
        }
    }
    client.report()
}
