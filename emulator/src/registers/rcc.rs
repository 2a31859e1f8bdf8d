//! RCC: oscillators, the clock of the core, clocks and resets of the blocks, why there was a reset.

use super::{Access, CLOCK_HZ, Time, US};
use crate::failure::Refusal;

/// From switching on to ready: the crystal, the PLL.
const CRYSTAL_READY: Time = 2000 * US;
const PLL_READY: Time = 15 * US;
const INTERNAL_READY: Time = 4 * US;
/// The crystal X3 of the board.
const CRYSTAL_HZ: u64 = 24_000_000;
const INTERNAL_HZ: u64 = 16_000_000;

const CSR: u32 = 0x94;
/// The crystal is watched.
const SECURITY: u32 = 1 << 19;
/// Flags of CSR: why there was a reset.
const FLAGS: u32 = 0xFE00_0000;

/// Why the chip begins anew.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reset {
    /// The power came on.
    PowerOn,
    /// The supply fell below the brown-out's level for a moment: the RAM keeps what it had.
    BrownOut,
    /// The pin NRST.
    Pin,
    /// The watchdog.
    Watchdog,
    /// The program asked for it.
    Software,
}

impl Reset {
    fn flag(self) -> u32 {
        match self {
            // The pin is pulled low inside, too, whatever causes a reset.
            Self::PowerOn | Self::BrownOut => 1 << 27 | 1 << 26,
            Self::Pin => 1 << 26,
            Self::Watchdog => 1 << 29 | 1 << 26,
            Self::Software => 1 << 28 | 1 << 26,
        }
    }
}

/// The registers, by their offset divided by four.
#[derive(Clone, Debug)]
pub struct Rcc {
    words: [u32; 0xA0 / 4],
    ready: [Time; 3],
    /// False: the crystal never starts.
    pub crystal: bool,
    /// The crystal was found to have failed.
    crystal_failed: bool,
}

impl Rcc {
    /// After a reset; the flags of earlier resets stay but where the supply was gone.
    pub fn after(reset: Reset, flags: u32) -> Self {
        let mut words = [0; 0xA0 / 4];
        words[0] = 0x0000_0063 | 1 << 8;
        words[CSR as usize / 4] = reset.flag() | flags;
        words[1] = 0x4000_0000;
        words[0x48 / 4] = 0x0000_0100;
        Self { words, ready: [0; 3], crystal: true, crystal_failed: false }
    }

    /// The crystal fails; whether the NMI tells so, the chip being at its own oscillator by then.
    pub fn fail_crystal(&mut self) -> bool {
        let is_watched = self.word(0x00) & SECURITY != 0;
        self.crystal = false;
        if is_watched {
            self.words[0] &= !(SECURITY | 1 << 16);
            self.words[2] = self.words[2] & !3 | 1;
            self.crystal_failed = true;
        }
        is_watched
    }

    /// The flags that tell why there were resets.
    pub fn flags(&self) -> u32 {
        self.word(CSR) & FLAGS
    }

    fn word(&self, offset: u32) -> u32 {
        self.words[offset as usize / 4]
    }

    /// Whether a block has its clock, by register and bit.
    pub fn is_on(&self, (register, bit): (u32, u32)) -> bool {
        self.word(register) >> bit & 1 == 1
    }

    /// Frequency of the core [Hz].
    pub fn core_hz(&self) -> u64 {
        let config = self.word(0x08);
        let source = match config & 3 {
            3 => self.pll_hz(),
            2 => CRYSTAL_HZ,
            _ => INTERNAL_HZ,
        };
        match config >> 4 & 0xF {
            divided @ 8..12 => source >> (divided - 7),
            _ => source,
        }
    }

    /// Frequency of LPTIM1's clock, of which the oscillator of low speed is one [Hz].
    pub fn low_power_timer_hz(&self, low_speed_hz: u64) -> u64 {
        match self.word(0x88) >> 18 & 3 {
            0 => self.core_hz(),
            1 if self.word(CSR) & 1 == 1 => low_speed_hz,
            _ => 0,
        }
    }

    fn pll_hz(&self) -> u64 {
        let config = self.word(0x0C);
        let field = |shift: u32, bits: u32| u64::from(config >> shift & ((1 << bits) - 1));
        let source = if field(0, 2) == 3 { CRYSTAL_HZ } else { INTERNAL_HZ };
        source / (field(4, 4) + 1) * field(8, 7) / (2 * (field(25, 2) + 1))
    }

    /// Whether core and buses have the 170 MHz that all other models count in.
    pub fn is_full_speed(&self) -> bool {
        self.core_hz() == CLOCK_HZ && self.word(0x08) & 0x3F00 == 0
    }

    /// A register.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read(&self, offset: u32, now: Time) -> Access<u32> {
        let word = *self.words.get(offset as usize / 4).ok_or(Refusal::NotModelled)?;
        match offset {
            0x00 => Ok(word | self.ready_bits(word, now)),
            // The switch is done at once.
            0x08 => Ok(word & !0xC | (word & 3) << 2),
            // CIFR; nothing else of it is modelled.
            0x1C => Ok(u32::from(self.crystal_failed) << 8),
            // Low-speed and 48 MHz oscillators are ready at once.
            0x94 | 0x98 => Ok(word | (word & 1) << 1),
            0x04 | 0x0C | 0x28..0x44 | 0x48..0x64 | 0x68..0x84 | 0x88 | 0x90 | 0x9C => Ok(word),
            _ => Err(Refusal::NotModelled),
        }
    }

    fn ready_bits(&self, word: u32, now: Time) -> u32 {
        let [internal, crystal, pll] = [8, 16, 24].map(|bit| word >> bit & 1 == 1);
        let crystal = crystal && self.crystal && now >= self.ready[1];
        let source = if self.word(0x0C) & 3 == 3 { crystal } else { internal };
        u32::from(internal && now >= self.ready[0]) << 10
            | u32::from(crystal) << 17
            | u32::from(pll && source && now >= self.ready[2]) << 25
    }

    /// The same, written. What is reset by it is told by its register and the bits that rose.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn write(&mut self, offset: u32, value: u32, now: Time) -> Access<Option<(u32, u32)>> {
        let before = *self.words.get(offset as usize / 4).ok_or(Refusal::NotModelled)?;
        let mut word = value;
        match offset {
            0x00 => {
                let delays = [(8, INTERNAL_READY), (16, CRYSTAL_READY), (24, PLL_READY)];
                for (index, (bit, delay)) in delays.into_iter().enumerate() {
                    if value & !before & 1 << bit != 0 {
                        self.ready[index] = now + delay;
                    }
                }
            }
            // RMVF forgets the flags.
            0x94 if value & 1 << 23 != 0 => word = value & !FLAGS & !(1 << 23),
            0x94 => word = value & !FLAGS | before & FLAGS,
            0x08 | 0x0C | 0x28..0x44 | 0x48..0x64 | 0x68..0x84 | 0x88 | 0x90 | 0x98 | 0x9C => {}
            _ => return Err(Refusal::NotModelled),
        }
        self.words[offset as usize / 4] = word;
        Ok((0x28..0x44).contains(&offset).then_some((offset, value & !before)))
    }
}
