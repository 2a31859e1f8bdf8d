//! RNG: random words, here of a generator that repeats.

use super::{Access, Level};
use crate::failure::Refusal;

const ENABLE: u32 = 1 << 2;
const INTERRUPT: u32 = 1 << 3;
const CONDITIONING_RESET: u32 = 1 << 30;

/// The generator.
#[derive(Clone, Debug)]
pub struct Random {
    control: u32,
    state: u64,
}

impl Random {
    /// Same seed, same words.
    pub fn new(seed: u64) -> Self {
        Self { control: 0, state: seed }
    }

    /// Whether its interrupt is up.
    pub fn level(&self) -> Level {
        self.control & (ENABLE | INTERRUPT) == ENABLE | INTERRUPT && !self.is_resetting()
    }

    fn is_resetting(&self) -> bool {
        self.control & CONDITIONING_RESET != 0
    }

    /// A register.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read(&mut self, offset: u32) -> Access<u32> {
        match offset {
            0x00 => Ok(self.control),
            0x04 => Ok(u32::from(self.control & ENABLE != 0 && !self.is_resetting())),
            0x08 => {
                // Knuth's linear congruential generator; its upper half is random enough here.
                self.state = self.state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                Ok((self.state >> 32) as u32)
            }
            _ => Err(Refusal::NotModelled),
        }
    }

    /// The same, written.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn write(&mut self, offset: u32, value: u32) -> Access<()> {
        match offset {
            0x00 => self.control = value,
            // Flags of errors, of which there are none.
            0x04 => {}
            _ => return Err(Refusal::NotModelled),
        }
        Ok(())
    }
}
