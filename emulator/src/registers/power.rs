//! PWR: the voltage of the core.

use super::Access;
use crate::failure::Refusal;

/// Range 1, normal mode.
const R1MODE: u32 = 1 << 8;

/// The registers that set the voltage.
#[derive(Clone, Debug)]
pub struct Power {
    control: [u32; 4],
    control5: u32,
}

impl Default for Power {
    fn default() -> Self {
        Self { control: [0x0000_0200, 0, 0x0000_8000, 0], control5: R1MODE }
    }
}

impl Power {
    /// Whether the core has the voltage for more than 150 MHz.
    pub fn boosted(&self) -> bool {
        self.control5 & R1MODE == 0
    }

    /// A register.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read(&self, offset: u32) -> Access<u32> {
        match offset {
            0x00..0x10 => Ok(self.control[offset as usize / 4]),
            // The voltage has settled.
            0x14 => Ok(0x0000_0100),
            0x80 => Ok(self.control5),
            _ => Err(Refusal::NotModelled),
        }
    }

    /// The same, written.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn write(&mut self, offset: u32, value: u32) -> Access<()> {
        match offset {
            0x00..0x10 => self.control[offset as usize / 4] = value,
            0x80 => self.control5 = value,
            _ => return Err(Refusal::NotModelled),
        }
        Ok(())
    }
}
