//! Flash whose power fails after any byte, as badly as flash can.
#![allow(dead_code)]

use std::collections::BTreeSet;

use embedded_storage::nor_flash::{ErrorType, NorFlash, NorFlashErrorKind, ReadNorFlash};
use firmware::store::{Layout, RamFlash, Store};

pub const LAYOUT: Layout = Layout::G474;
/// What the store uses, and a page more.
pub const BYTES: usize = LAYOUT.used_bytes() as usize + 2048;
const WORD: usize = 8;

/// What a word looks like during whose writing, or a page during whose erasure, the power failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Torn {
    /// As far as it got, byte by byte.
    UpToThere,
    /// Some of the bits that were to change have changed.
    SomeBits,
    /// Any bits at all.
    AnyBits,
    /// The flash reports an error where it is read.
    Unreadable,
    /// Still as before; but a word can no longer be written.
    AsBefore,
    /// As if it were done.
    AsAfter,
}

impl Torn {
    pub const ALL: [Self; 6] = [
        Self::UpToThere,
        Self::SomeBits,
        Self::AnyBits,
        Self::Unreadable,
        Self::AsBefore,
        Self::AsAfter,
    ];
}

/// Flash that obeys the rules until its power fails.
#[derive(Clone, Debug)]
pub struct FailingFlash {
    ram: RamFlash<Vec<u8>>,
    /// Bytes written and erased since the power came.
    pub work: usize,
    /// After so many bytes the power fails.
    pub fails_after: usize,
    pub torn: Torn,
    pub rng: Rng,
    powered: bool,
    unreadable: BTreeSet<usize>,
    spent: BTreeSet<usize>,
}

/// Repeatable rng (xorshift).
#[derive(Clone, Debug)]
pub struct Rng(pub u64);

impl Rng {
    pub fn throw(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }
}

impl FailingFlash {
    pub fn new() -> Self {
        Self {
            ram: RamFlash::new(vec![0xFF; BYTES]),
            work: 0,
            fails_after: usize::MAX,
            torn: Torn::UpToThere,
            rng: Rng(1),
            powered: true,
            unreadable: BTreeSet::new(),
            spent: BTreeSet::new(),
        }
    }

    /// The same, powered, until so many bytes are written or erased.
    pub fn powered(mut self, fails_after: usize, torn: Torn) -> Self {
        (self.work, self.fails_after, self.torn, self.powered) = (0, fails_after, torn, true);
        self.rng = Rng(0x9E37_79B9 ^ (fails_after as u64) << 8 | 1);
        self
    }

    /// The same, powered for good.
    pub fn repaired(self) -> Self {
        self.powered(usize::MAX, Torn::UpToThere)
    }

    pub fn bytes_mut(&mut self) -> &mut [u8] {
        self.ram.bytes_mut()
    }

    pub fn bytes(&self) -> &[u8] {
        self.ram.bytes()
    }

    /// A word that the flash cannot read any more.
    pub fn break_word(&mut self, offset: usize) {
        self.unreadable.insert(offset / WORD);
    }

    /// Bytes that can still be changed, of `wanted`; power fails if they are fewer.
    fn spend(&mut self, wanted: usize) -> usize {
        let left = self.fails_after.saturating_sub(self.work).min(wanted);
        self.work += left;
        self.powered = left == wanted;
        left
    }

    fn write_word(&mut self, offset: usize, new: &[u8]) -> Result<(), NorFlashErrorKind> {
        let word = offset / WORD;
        if self.spent.contains(&word) || self.ram.bytes()[offset..][..WORD] != [0xFF; WORD] {
            return Err(NorFlashErrorKind::Other);
        }
        let done = self.spend(WORD);
        if done > 0 {
            self.spent.insert(word);
            self.change(offset, new, done);
        }
        self.alive()
    }

    /// Changes bytes to `new`; only the first `done` could be finished.
    fn change(&mut self, offset: usize, new: &[u8], done: usize) {
        let mut torn = self.torn;
        if done == new.len() {
            torn = Torn::AsAfter;
        }
        if torn == Torn::Unreadable {
            let words = offset / WORD..(offset + new.len()) / WORD;
            let rng = &mut self.rng;
            self.unreadable.extend(words.filter(|_| new.len() == WORD || rng.throw() & 1 == 0));
        }
        for (at, &new) in new.iter().enumerate() {
            let rng = self.rng.throw() as u8;
            let byte = &mut self.ram.bytes_mut()[offset + at];
            *byte = match torn {
                Torn::UpToThere | Torn::Unreadable => {
                    if at < done {
                        new
                    } else {
                        *byte
                    }
                }
                Torn::SomeBits => (*byte & rng) | (new & !rng),
                Torn::AnyBits => rng,
                Torn::AsBefore => *byte,
                Torn::AsAfter => new,
            };
        }
    }

    fn alive(&self) -> Result<(), NorFlashErrorKind> {
        if self.powered { Ok(()) } else { Err(NorFlashErrorKind::Other) }
    }
}

impl ErrorType for FailingFlash {
    type Error = NorFlashErrorKind;
}

impl ReadNorFlash for FailingFlash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Self::Error> {
        self.alive()?;
        let words = offset as usize / WORD..(offset as usize + bytes.len()).div_ceil(WORD);
        if self.unreadable.range(words).next().is_some() {
            return Err(NorFlashErrorKind::Other);
        }
        self.ram.read(offset, bytes)
    }

    fn capacity(&self) -> usize {
        self.ram.capacity()
    }
}

impl NorFlash for FailingFlash {
    const WRITE_SIZE: usize = WORD;
    const ERASE_SIZE: usize = 2048;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Self::Error> {
        self.alive()?;
        assert!(from < to && (from | to).is_multiple_of(2048), "{from} {to}");
        for page in (from as usize..to as usize).step_by(2048) {
            let done = self.spend(2048);
            if done > 0 {
                let (first, behind) = (page / WORD, (page + 2048) / WORD);
                self.unreadable.retain(|word| !(first..behind).contains(word));
                if done == 2048 {
                    self.spent.retain(|word| !(first..behind).contains(word));
                }
                self.change(page, &[0xFF; 2048], done);
            }
            self.alive()?;
        }
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Self::Error> {
        self.alive()?;
        assert!((offset as usize | bytes.len()).is_multiple_of(WORD), "{offset} {}", bytes.len());
        for (at, word) in (offset as usize..).step_by(WORD).zip(bytes.chunks_exact(WORD)) {
            self.write_word(at, word)?;
        }
        Ok(())
    }
}

/// The store in such a flash.
pub fn store(flash: FailingFlash) -> Store<FailingFlash> {
    Store::new(flash, LAYOUT.bank_start, LAYOUT)
}
