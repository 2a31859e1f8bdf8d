//! IWDG: counts down on a clock of its own and resets the chip unless it is reloaded.

use super::{Access, CLOCK_HZ, Time};
use crate::failure::Refusal;

const RELOAD: u32 = 0xAAAA;
const UNLOCK: u32 = 0x5555;
const START: u32 = 0xCCCC;

/// The watchdog.
#[derive(Clone, Debug)]
pub struct Watchdog {
    prescaler: u32,
    reload: u32,
    window: u32,
    unlocked: bool,
    /// When it was reloaded, once it runs.
    since: Option<Time>,
    /// Frequency of its clock [Hz].
    pub clock_hz: u64,
    /// Longest time between two reloads [cycles].
    pub longest: Time,
}

impl Default for Watchdog {
    fn default() -> Self {
        Self {
            prescaler: 0,
            reload: 0xFFF,
            window: 0xFFF,
            unlocked: false,
            since: None,
            clock_hz: 32_000,
            longest: 0,
        }
    }
}

impl Watchdog {
    /// When it resets the chip, if it runs.
    pub fn bites_at(&self) -> Option<Time> {
        let counts = u64::from(self.reload + 1) << (2 + self.prescaler.min(6));
        self.since.map(|since| since + counts * CLOCK_HZ / self.clock_hz)
    }

    /// A register.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read(&self, offset: u32) -> Access<u32> {
        match offset {
            0x04 => Ok(self.prescaler),
            0x08 => Ok(self.reload),
            // Values are taken over at once.
            0x0C => Ok(0),
            0x10 => Ok(self.window),
            _ => Err(Refusal::NotModelled),
        }
    }

    /// The same, written.
    ///
    /// # Errors
    /// None of those modelled, or one that is locked.
    pub fn write(&mut self, offset: u32, value: u32, now: Time) -> Access<()> {
        match (offset, value) {
            (0x00, RELOAD) => self.restart(now),
            (0x00, UNLOCK) => self.unlocked = true,
            (0x00, START) => {
                self.unlocked = false;
                self.since = Some(now);
            }
            (0x04, _) if self.unlocked => self.prescaler = value & 7,
            (0x08, _) if self.unlocked => self.reload = value & 0xFFF,
            _ => return Err(Refusal::Value(value)),
        }
        Ok(())
    }

    fn restart(&mut self, now: Time) {
        self.unlocked = false;
        if let Some(since) = &mut self.since {
            self.longest = self.longest.max(now - *since);
            *since = now;
        }
    }
}
