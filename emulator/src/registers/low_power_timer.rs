//! LPTIM1: counts a clock that is not the core's, from a start on and without an end.

use super::{Access, CLOCK_HZ, Time};
use crate::failure::Refusal;

const ENABLE: u32 = 1;
const START: u32 = 1 << 2;

/// The counter.
#[derive(Clone, Debug, Default)]
pub struct LowPowerTimer {
    control: u32,
    reload: u32,
    /// Counts since the start, times the core's frequency.
    counted: u64,
    /// How far that is.
    at: Time,
}

impl LowPowerTimer {
    /// Counts on at a frequency [Hz].
    pub fn advance(&mut self, now: Time, clock_hz: u64) {
        let elapsed = now - std::mem::replace(&mut self.at, now);
        if self.control & START != 0 {
            self.counted += elapsed * clock_hz;
        }
    }

    fn count(&self) -> u32 {
        (self.counted / CLOCK_HZ) as u32 % (self.reload + 1)
    }

    /// A register.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read(&self, offset: u32) -> Access<u32> {
        match offset {
            0x10 => Ok(self.control),
            0x18 => Ok(self.reload),
            0x1C => Ok(self.count()),
            _ => Err(Refusal::NotModelled),
        }
    }

    /// The same, written.
    ///
    /// # Errors
    /// None of those modelled, or one that cannot be written now.
    pub fn write(&mut self, offset: u32, value: u32) -> Access<()> {
        let is_enabled = self.control & ENABLE != 0;
        match (offset, value) {
            // A start takes a timer that is enabled.
            (0x10, ENABLE) => self.control = value,
            (0x10, _) if is_enabled && value == ENABLE | START => self.control = value,
            (0x18, 1..=0xFFFF) if is_enabled => self.reload = value,
            _ => return Err(Refusal::Value(value)),
        }
        Ok(())
    }
}
