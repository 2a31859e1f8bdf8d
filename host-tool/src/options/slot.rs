//! The parameter slot, by its name.

use clap::ValueEnum;
use firmware::store::Slot;

/// A slot on the command line.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum SlotName {
    /// The first.
    A,
    /// The second.
    B,
}

impl From<SlotName> for Slot {
    fn from(name: SlotName) -> Self {
        match name {
            SlotName::A => Self::A,
            SlotName::B => Self::B,
        }
    }
}
