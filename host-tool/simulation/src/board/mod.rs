//! The control firmware, wherever it runs.

mod in_process;
mod qemu;

pub use in_process::InProcess;
pub use qemu::{Qemu, QemuSettings};

use std::path::PathBuf;

use firmware::lockstep::Reply;
use firmware::{BlockError, ParameterBlock};

/// A board in lockstep with a simulated robot.
pub trait Board {
    /// Takes a parameter block; the reference does not run yet.
    fn load(&mut self, block: &ParameterBlock) -> Result<(), BoardError>;
    /// Begins the reference at the next tick.
    fn start(&mut self) -> Result<(), BoardError>;
    /// One tick: counts in, codes out.
    fn tick(&mut self, counts: &[i32; 3]) -> Result<Reply, BoardError>;
}

/// Why a board does not answer.
#[derive(Debug, thiserror::Error)]
pub enum BoardError {
    /// The block is not one that the firmware takes.
    #[error("the parameter block is refused: {0}")]
    Block(BlockError),
    /// The firmware refused what the host's own check let pass.
    #[error("the board refused a request ({0})")]
    Refused(&'static str),
    /// QEMU could not be started.
    #[error("QEMU ({program}) does not start: {source}")]
    Start {
        /// The program called.
        program: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// QEMU ended, or never began to talk.
    #[error("the firmware in QEMU has ended: {0}")]
    Ended(String),
    /// The link to QEMU broke.
    #[error("the link to the firmware in QEMU broke: {0}")]
    Link(#[from] std::io::Error),
}
