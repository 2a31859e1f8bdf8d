//! FLASH: two banks that are programmed by double words and erased by pages, and take their time.

use std::collections::BTreeSet;

use super::{Access, Level, Time, US};
use crate::failure::Refusal;
use crate::memory_map::{BANK_BYTES, BANK2_START, FLASH_START};

/// Bytes of a double word and of a page.
const DOUBLE_WORD: usize = 8;
const PAGE: usize = 2048;
/// Typical times of the data sheet: 81.7 us and 22.02 ms.
const PROGRAM: Time = 82 * US;
const ERASE: Time = 22_020 * US;
const KEYS: [u32; 2] = [0x4567_0123, 0xCDEF_89AB];

const PROGRAMS: u32 = 1;
const ERASES_PAGE: u32 = 1 << 1;
const BANK2: u32 = 1 << 11;
const START: u32 = 1 << 16;
const LOCK: u32 = 1 << 31;
/// Mass erases, fast programming, interrupts.
const NOT_MODELLED: u32 = 1 << 2 | 1 << 15 | 1 << 18 | 3 << 24 | 1 << 27;
const PROGRAM_ERROR: u32 = 1 << 3;
const SEQUENCE_ERROR: u32 = 1 << 7;
const BUSY: u32 = 1 << 16;
const ECC_TWO_BITS: u32 = 1 << 31;

/// What the flash is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Operation {
    Program { at: usize, data: [u8; DOUBLE_WORD] },
    Erase { at: usize },
}

/// What an operation leaves that the power cuts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Torn {
    /// A double word whose checksum does not fit, and half of what was to be done.
    #[default]
    Unreadable,
    /// What was there before.
    Untouched,
    /// All that was to be done.
    Done,
}

/// The flash and its registers.
#[derive(Clone, Debug)]
pub struct Flash {
    /// All that it holds, from the begin of bank 1 on.
    pub bytes: Vec<u8>,
    /// Double words, by their offset, whose checksum does not fit.
    pub unreadable: BTreeSet<usize>,
    access: u32,
    status: u32,
    control: u32,
    ecc: u32,
    keys: usize,
    first_word: Option<(usize, u32)>,
    running: Option<(Operation, Time)>,
    /// Operations begun since the first power-on.
    pub operations: u64,
    /// The power fails in the middle of the operation of this number.
    pub cut_at: Option<u64>,
    /// How long a page takes to be erased.
    pub erase: Time,
    /// What that operation leaves.
    pub torn: Torn,
    /// Waits of reads for an operation in their bank, to be added to the time [cycles].
    pub stall: Time,
}

impl Flash {
    /// With these bytes.
    pub fn new(bytes: Vec<u8>) -> Self {
        Self {
            bytes,
            unreadable: BTreeSet::new(),
            access: 0x0004_0600,
            status: 0,
            control: LOCK,
            ecc: 0,
            keys: 0,
            first_word: None,
            running: None,
            operations: 0,
            cut_at: None,
            erase: ERASE,
            torn: Torn::default(),
            stall: 0,
        }
    }

    /// After a reset, which may have torn an operation that was going on.
    pub fn after_reset(mut self) -> Self {
        match (self.running, self.torn) {
            (Some((operation, _)), Torn::Unreadable) => self.leave_half_done(operation),
            (Some((_, done)), Torn::Done) => self.advance(done),
            _ => {}
        }
        let Self { operations, erase, torn, unreadable, .. } = self;
        Self { operations, erase, torn, unreadable, ..Self::new(self.bytes) }
    }

    /// A double word half programmed has a checksum that does not fit; a page half erased has one
    /// double word like that, and nothing but ones before it.
    fn leave_half_done(&mut self, operation: Operation) {
        match operation {
            Operation::Program { at, data } => {
                self.bytes[at..at + 4].copy_from_slice(&data[..4]);
                self.unreadable.insert(at);
            }
            Operation::Erase { at } => {
                self.bytes[at..at + PAGE / 2].fill(0xFF);
                self.unreadable.retain(|word| !(at..at + PAGE / 2).contains(word));
                self.unreadable.insert(at + PAGE / 2);
            }
        }
    }

    /// Wait states of the flash, and whether the instruction cache is on.
    pub fn timing(&self) -> (u64, bool) {
        (u64::from(self.access & 0xF), self.access & 1 << 9 != 0)
    }

    /// Whether a read found a checksum that does not fit, until the program clears the flag.
    pub fn raises_nmi(&self) -> Level {
        self.ecc & ECC_TWO_BITS != 0
    }

    /// Whether the power fails now.
    pub fn is_cut(&self) -> bool {
        self.running.is_some() && self.cut_at == Some(self.operations)
    }

    /// Takes it to a point of time.
    pub fn advance(&mut self, now: Time) {
        let Some((operation, _)) = self.running.filter(|(_, done)| *done <= now) else { return };
        self.running = None;
        match operation {
            Operation::Program { at, data } => {
                self.bytes[at..at + DOUBLE_WORD].copy_from_slice(&data);
            }
            Operation::Erase { at } => {
                self.bytes[at..at + PAGE].fill(0xFF);
                self.unreadable.retain(|word| !(at..at + PAGE).contains(word));
            }
        }
    }

    /// Reads bytes of bank 2, as the processor does; waits for an operation there.
    pub fn read_bank2(&mut self, offset: usize, bytes: usize, now: Time) -> u64 {
        if let Some((_, done)) = self.running {
            self.stall += done.saturating_sub(now);
            self.advance(done);
        }
        let at = BANK_BYTES + offset;
        if self.unreadable.contains(&(at - at % DOUBLE_WORD)) {
            self.ecc = ECC_TWO_BITS | 1 << 21 | (offset / DOUBLE_WORD) as u32 & 0x7_FFFF;
        }
        let mut value = [0; 8];
        value[..bytes].copy_from_slice(&self.bytes[at..at + bytes]);
        u64::from_le_bytes(value)
    }

    /// Takes a word into bank 2: the second of a double word starts programming.
    ///
    /// # Errors
    /// Not a word, or not while programming is enabled.
    pub fn write_bank2(
        &mut self,
        offset: usize,
        bytes: usize,
        value: u32,
        now: Time,
    ) -> Access<()> {
        if bytes != 4 || self.control & (PROGRAMS | LOCK) != PROGRAMS || self.running.is_some() {
            return Err(Refusal::BusFault);
        }
        let at = BANK_BYTES + offset;
        match self.first_word.take() {
            None if at.is_multiple_of(DOUBLE_WORD) => self.first_word = Some((at, value)),
            Some((first, word)) if at == first + 4 => {
                let mut data = [0; DOUBLE_WORD];
                data[..4].copy_from_slice(&word.to_le_bytes());
                data[4..].copy_from_slice(&value.to_le_bytes());
                self.program(first, data, now);
            }
            _ => self.status |= SEQUENCE_ERROR,
        }
        Ok(())
    }

    fn program(&mut self, at: usize, data: [u8; DOUBLE_WORD], now: Time) {
        let is_erased = self.bytes[at..at + DOUBLE_WORD].iter().all(|byte| *byte == 0xFF);
        let is_readable = !self.unreadable.contains(&at);
        match is_erased && is_readable || data == [0; DOUBLE_WORD] {
            true => self.begin(Operation::Program { at, data }, now + PROGRAM),
            false => self.status |= PROGRAM_ERROR,
        }
    }

    fn begin(&mut self, operation: Operation, done: Time) {
        self.operations += 1;
        self.running = Some((operation, done));
    }

    /// A register.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read(&self, offset: u32) -> Access<u32> {
        match offset {
            0x00 => Ok(self.access),
            0x10 => Ok(self.status | if self.running.is_some() { BUSY } else { 0 }),
            0x14 => Ok(self.control),
            0x18 => Ok(self.ecc),
            // Two banks, and all else as delivered.
            0x20 => Ok(0xFFEF_F8AA),
            _ => Err(Refusal::NotModelled),
        }
    }

    /// The same, written.
    ///
    /// # Errors
    /// None of those modelled, or what the chip answers with a bus fault.
    pub fn write(&mut self, offset: u32, value: u32, now: Time) -> Access<()> {
        match offset {
            0x00 => self.access = value,
            0x08 => return self.unlock(value),
            // Ones clear.
            0x10 => self.status &= !(value & 0xC3FB),
            0x14 if self.control & LOCK != 0 && value & LOCK == 0 => return Err(Refusal::BusFault),
            0x14 if value & NOT_MODELLED != 0 => return Err(Refusal::Value(value)),
            0x14 => self.set_control(value, now)?,
            0x18 => self.ecc &= !(value & 0xF000_0000),
            _ => return Err(Refusal::NotModelled),
        }
        Ok(())
    }

    fn unlock(&mut self, key: u32) -> Access<()> {
        if self.keys >= KEYS.len() || KEYS[self.keys] != key || self.control & LOCK == 0 {
            return Err(Refusal::BusFault);
        }
        self.keys += 1;
        if self.keys == KEYS.len() {
            (self.control, self.keys) = (self.control & !LOCK, 0);
        }
        Ok(())
    }

    fn set_control(&mut self, value: u32, now: Time) -> Access<()> {
        if self.running.is_some() {
            return Err(Refusal::BusFault);
        }
        self.control = value & !START;
        if value & START != 0 {
            // Bank 1 holds the program.
            if value & (ERASES_PAGE | BANK2) != ERASES_PAGE | BANK2 {
                return Err(Refusal::Value(value));
            }
            let page = (value >> 3 & 0x7F) as usize;
            let at = (BANK2_START - FLASH_START) as usize + page * PAGE;
            self.begin(Operation::Erase { at }, now + self.erase);
        }
        Ok(())
    }

    /// When an operation ends.
    pub fn next_event(&self) -> Option<Time> {
        self.running.map(|(_, done)| done)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unlocked() -> Flash {
        let mut flash = Flash::new(vec![0xFF; 2 * BANK_BYTES]);
        KEYS.iter().for_each(|key| flash.write(0x08, *key, 0).unwrap());
        flash.write(0x14, PROGRAMS, 0).unwrap();
        flash
    }

    #[test]
    fn a_double_word_takes_two_words_and_its_time() {
        let mut flash = unlocked();
        flash.write_bank2(0, 4, 0x0102_0304, 0).unwrap();
        assert_eq!(flash.read(0x10).unwrap(), 0);
        flash.write_bank2(4, 4, 0x0506_0708, 0).unwrap();
        assert_eq!(flash.read(0x10).unwrap(), BUSY);
        flash.advance(PROGRAM);
        assert_eq!(flash.read_bank2(0, 8, PROGRAM), 0x0506_0708_0102_0304);
        flash.write_bank2(0, 4, 1, PROGRAM).unwrap();
        flash.write_bank2(4, 4, 1, PROGRAM).unwrap();
        assert_eq!(flash.read(0x10).unwrap(), PROGRAM_ERROR, "not erased");
    }

    #[test]
    fn a_double_word_half_programmed_is_not_readable_until_its_page_is_erased() {
        let mut flash = unlocked();
        flash.write_bank2(8, 4, 1, 0).unwrap();
        flash.write_bank2(12, 4, 2, 0).unwrap();
        let mut flash = flash.after_reset();
        flash.read_bank2(0, 4, 0);
        assert!(!flash.raises_nmi());
        flash.read_bank2(8, 4, 0);
        assert!(flash.raises_nmi());
        flash.write(0x18, ECC_TWO_BITS, 0).unwrap();
        assert!(!flash.raises_nmi());
    }

    #[test]
    fn a_locked_flash_answers_with_a_bus_fault() {
        let mut flash = Flash::new(vec![0xFF; 2 * BANK_BYTES]);
        assert_eq!(flash.write(0x14, PROGRAMS, 0), Err(Refusal::BusFault));
        assert_eq!(flash.write_bank2(0, 4, 0, 0), Err(Refusal::BusFault));
        assert_eq!(flash.write(0x08, 1, 0), Err(Refusal::BusFault));
    }
}
