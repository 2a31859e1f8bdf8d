//! Text for the standard output, which may be closed or full.

use std::fmt::Display;
use std::io::{ErrorKind, Write};

use super::json_mode::is_json;
use crate::failure::Failure;

/// Writes a line; that nobody reads it any more is no failure. Where the answer is JSON, words go to the
/// standard error.
///
/// # Errors
/// The system does not take it, as on a full disk.
pub fn print_line(line: impl Display) -> Result<(), Failure> {
    if is_json() {
        eprintln!("{line}");
        return Ok(());
    }
    match write(&format!("{line}\n")) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(not_written(&error)),
        _ => Ok(()),
    }
}

/// Writes a line if the output takes it: an arm that moves does not depend on the terminal.
pub fn try_print_line(line: impl Display) {
    if is_json() {
        let _ = writeln!(std::io::stderr(), "{line}");
    } else {
        let _ = write(&format!("{line}\n"));
    }
}

/// Writes a text as it is.
///
/// # Errors
/// Those of the system; of the kind [`ErrorKind::BrokenPipe`] where nobody reads any more.
pub fn write(text: &str) -> std::io::Result<()> {
    let mut output = std::io::stdout().lock();
    output.write_all(text.as_bytes()).and_then(|()| output.flush())
}

/// The failure where the standard output does not take a text.
pub fn not_written(error: &std::io::Error) -> Failure {
    let message = format!("the standard output cannot be written: {error}");
    Failure::new(message, "send it to a disk that has room")
}
