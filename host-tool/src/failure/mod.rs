//! Failures of commands: message, hint and exit status.

use files::FileError;
use simulation::board::BoardError;

mod flash_error;
mod link_error;
mod plant_error;
pub mod status;
mod step_error;

pub use status::{BAD_INPUT, INTERRUPTED, NOT_PASSED};

/// The message when a command fails: what is wrong, and what to do about it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct Failure {
    /// What is wrong, with the place and the offending value.
    pub message: String,
    /// What to do about it.
    pub hint: String,
    /// The exit status.
    pub status: u8,
}

impl Failure {
    /// A failure in words.
    pub fn new(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { message: message.into(), hint: hint.into(), status: BAD_INPUT }
    }

    /// The command has done its work, and what it found does not pass.
    pub fn not_passed(message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { status: NOT_PASSED, ..Self::new(message, hint) }
    }

    /// The user ended the command with Ctrl-C; what it has come to so far.
    pub fn interrupted(message: impl Into<String>) -> Self {
        Self { message: message.into(), hint: String::new(), status: INTERRUPTED }
    }

    /// The lines that go to the terminal.
    pub fn report(&self) -> String {
        match self.hint.as_str() {
            _ if self.status == INTERRUPTED => format!("interrupted: {}", self.message),
            hint if self.status == NOT_PASSED => {
                format!("not passed: {}\nhint: {hint}", self.message)
            }
            "" => format!("error: {}", self.message),
            hint => format!("error: {}\nhint: {hint}", self.message),
        }
    }
}

impl Failure {
    /// That of a file.
    fn from_file(error: &FileError) -> Self {
        Self::new(error.to_string(), error.hint())
    }
}

impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        Self::from_file(&error)
    }
}

impl From<BoardError> for Failure {
    fn from(error: BoardError) -> Self {
        let hint = match &error {
            BoardError::Block(_) => "correct the value in the model file",
            BoardError::Start { .. } => "`cargo xtask setup` installs QEMU and builds what it runs",
            _ => "rebuild the image with `cargo xtask firmware qemu`",
        };
        Self::new(error.to_string(), hint)
    }
}
