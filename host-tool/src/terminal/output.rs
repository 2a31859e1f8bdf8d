//! Text for the standard output, which may be closed or full.

use std::fmt::Display;
use std::io::{ErrorKind, Write};

use crate::failure::Failure;

/// Writes a line; that nobody reads it any more is no failure.
///
/// # Errors
/// The system does not take it, as on a full disk.
pub fn print_line(line: impl Display) -> Result<(), Failure> {
    match write(&format!("{line}\n")) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => Ok(written?),
    }
}

/// Writes a line if the output takes it: an arm that moves does not depend on the terminal.
pub fn try_print_line(line: impl Display) {
    let _ = write(&format!("{line}\n"));
}

/// Writes a text as it is.
///
/// # Errors
/// What the system says; of the kind [`ErrorKind::BrokenPipe`] where nobody reads any more.
pub fn write(text: &str) -> Result<(), NotWritten> {
    let mut output = std::io::stdout().lock();
    output.write_all(text.as_bytes()).and_then(|()| output.flush()).map_err(NotWritten)
}

/// The standard output does not take a text.
#[derive(Debug, thiserror::Error)]
#[error("the standard output cannot be written: {0}")]
pub struct NotWritten(std::io::Error);

impl NotWritten {
    /// The kind of the system's error.
    pub fn kind(&self) -> ErrorKind {
        self.0.kind()
    }
}

impl From<NotWritten> for Failure {
    fn from(error: NotWritten) -> Self {
        Self::new(error.to_string(), "send it to a disk that has room")
    }
}
