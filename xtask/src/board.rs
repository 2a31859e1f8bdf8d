//! The boards that there is an image for.

use anyhow::{Result, bail};

use crate::image::Sizes;

const KIB: u64 = 1024;

/// A board, real or emulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Board {
    /// QEMU's mps2-an386, for the end-to-end tests and the demo.
    Qemu,
    /// The NUCLEO-G474RE.
    Nucleo,
}

impl Board {
    /// Every board.
    pub const ALL: [Self; 2] = [Self::Qemu, Self::Nucleo];

    /// The boards named, or all if none is.
    pub fn parse(names: &[&str]) -> Result<Vec<Self>> {
        match names {
            [] => Ok(Self::ALL.to_vec()),
            _ => names.iter().map(|name| Self::named(name)).collect(),
        }
    }

    fn named(name: &str) -> Result<Self> {
        match Self::ALL.into_iter().find(|board| board.name() == name) {
            Some(board) => Ok(board),
            None => bail!("no board is called `{name}`: name qemu or nucleo, or none for both"),
        }
    }

    /// The short name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Qemu => "qemu",
            Self::Nucleo => "nucleo",
        }
    }

    /// The name of the firmware's binary, and of the feature that it requires.
    pub fn binary(self) -> &'static str {
        match self {
            Self::Qemu => "qemu-mps2-an386",
            Self::Nucleo => "nucleo-g474re",
        }
    }

    /// The largest image allowed: a share of the chip that leaves room to grow.
    pub fn limits(self) -> Option<Sizes> {
        match self {
            Self::Qemu => None,
            Self::Nucleo => Some(Sizes { flash: 192 * KIB, static_ram: 32 * KIB }),
        }
    }
}
