//! Why a run ends before its time.

use std::path::PathBuf;

/// Why a run ends before its time.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Failure {
    /// The image cannot be used.
    #[error("{}: no image for this board: {why}; `cargo xtask firmware nucleo` makes one", path.display())]
    Image {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        why: String,
    },
    /// An access that the model does not have.
    #[error("{kind} of {bytes} bytes at {address:#010x} by the code at {place}: {refusal}")]
    Access {
        /// `read` or `write`.
        kind: &'static str,
        /// Width [bytes].
        bytes: usize,
        /// Where.
        address: u32,
        /// The instruction, with the nearest symbol.
        place: String,
        /// Why not.
        refusal: Refusal,
    },
    /// The engine gave up.
    #[error("the engine stopped at {place}: {why}")]
    Engine {
        /// The instruction, with the nearest symbol.
        place: String,
        /// In the engine's words.
        why: String,
    },
    /// The core did what the model does not have.
    #[error("the core: {0}")]
    Core(String),
    /// The converter was treated against its data sheet.
    #[error("the converter: {0}")]
    Converter(String),
}

/// Why a register block does not take an access.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// There is no model of it.
    #[error("the register is not modelled")]
    NotModelled,
    /// The value asks for something that is not modelled.
    #[error("the value {0:#010x} asks for what is not modelled")]
    Value(u32),
    /// The block has no clock.
    #[error("the block has no clock")]
    NoClock,
    /// The pins are not given to the block.
    #[error("the pins are not given to this block")]
    Pins,
    /// The chip would raise a bus fault.
    #[error("the chip raises a bus fault here")]
    BusFault,
}
