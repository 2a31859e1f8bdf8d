//! Where things lie in bank 2 of the flash; board, emulator and host tool share it.

/// Bytes from one small record to the next.
pub(super) const NOTE_PLACE_BYTES: u32 = 64;

/// One of the two places of the parameter block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// The first.
    A,
    /// The second.
    B,
}

impl Slot {
    /// Both slots.
    pub const BOTH: [Self; 2] = [Self::A, Self::B];

    /// The other one.
    pub fn other(self) -> Self {
        match self {
            Self::A => Self::B,
            Self::B => Self::A,
        }
    }

    /// 0 or 1.
    pub fn index(self) -> usize {
        self as usize
    }

    /// The name that commands and messages use.
    pub fn name(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
        }
    }
}

impl core::fmt::Display for Slot {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "slot {}", self.name())
    }
}

/// What a pair of pages holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The parameter block: one record a page.
    Parameters,
    /// The latched fault: small records, one after the other.
    Fault,
    /// The key: likewise.
    Key,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Parameters, Self::Fault, Self::Key];

    /// What messages call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Parameters => "parameter block",
            Self::Fault => "fault record",
            Self::Key => "key record",
        }
    }
}

/// Addresses in flash; every page is erased alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// First address of the bank that nothing but the store uses.
    pub bank_start: u32,
    /// Length of that bank [bytes].
    pub bank_bytes: u32,
    /// Smallest piece that can be erased [bytes].
    pub page_bytes: u32,
    /// Pages of the slots A and B.
    pub parameters: [u32; 2],
    /// Pages of the latched fault.
    pub faults: [u32; 2],
    /// Pages of the key.
    pub key: [u32; 2],
}

impl Layout {
    /// The STM32G474RE in dual-bank mode (RM0440): bank 2 has 128 pages of 2 KiB.
    ///
    /// Every other page stays empty: a programmer that takes the chip for one of a single bank
    /// erases 4 KiB at a time.
    pub const G474: Self = Self {
        bank_start: 0x0804_0000,
        bank_bytes: 0x0004_0000,
        page_bytes: 2048,
        parameters: [0x0804_0000, 0x0804_1000],
        faults: [0x0804_2000, 0x0804_3000],
        key: [0x0804_4000, 0x0804_5000],
    };

    /// Bytes from the bank's start to the end of the last page in use.
    pub const fn used_bytes(&self) -> u32 {
        self.key[1] + self.page_bytes - self.bank_start
    }

    /// Address of a slot.
    pub fn slot(&self, slot: Slot) -> u32 {
        self.parameters[slot.index()]
    }

    /// The two pages of a kind.
    pub fn pages(&self, kind: Kind) -> [u32; 2] {
        match kind {
            Kind::Parameters => self.parameters,
            Kind::Fault => self.faults,
            Kind::Key => self.key,
        }
    }

    /// Bytes from one record to the next.
    pub(super) fn place_bytes(&self, kind: Kind) -> u32 {
        match kind {
            Kind::Parameters => self.page_bytes,
            Kind::Fault | Kind::Key => NOTE_PLACE_BYTES,
        }
    }
}
