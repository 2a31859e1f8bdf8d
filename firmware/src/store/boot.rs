//! What the board finds at power-on, and how it says so.

use core::fmt::{Display, Formatter, Result};

use super::layout::Slot;
use super::read::Content;
use crate::block::{BlockError, ParameterBlock};

/// What the board begins with.
#[derive(Clone, Debug, PartialEq)]
pub struct Boot {
    /// The parameters in force.
    pub block: ParameterBlock,
    /// Where they come from.
    pub source: Source,
    /// What the slots A and B hold.
    pub slots: [SlotState; 2],
}

/// Where the parameters in force come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The newest block that was ever committed.
    Newest {
        /// Its slot.
        slot: Slot,
        /// Its sequence number.
        sequence: u32,
    },
    /// The other slot: what may have been newer cannot be used.
    Other {
        /// The slot in force.
        slot: Slot,
        /// Its sequence number.
        sequence: u32,
    },
    /// No slot can be used: nothing is fed forward, and no joint gets a voltage.
    Defaults,
}

/// What a slot holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlotState {
    /// Which one.
    pub slot: Slot,
    /// Its address.
    pub address: u32,
    /// What lies there.
    pub content: Content,
    /// Why the block there is refused, if it is valid as a record.
    pub refused: Option<BlockError>,
}

impl SlotState {
    /// The sequence number of a block that can be used.
    pub fn usable(&self) -> Option<u32> {
        match (self.content, self.refused) {
            (Content::Valid { sequence, .. }, None) => Some(sequence),
            _ => None,
        }
    }

    /// Whether what lies here and cannot be used may be newer than the block of that number.
    fn may_be_newer_than(&self, sequence: u32) -> bool {
        match self.content {
            Content::Blank => false,
            Content::Unfinished { claim } | Content::Damaged { claim } => {
                claim.is_none_or(|claim| claim > sequence)
            }
            Content::Unreadable => true,
            Content::Valid { sequence: own, .. } => own > sequence,
        }
    }
}

impl Source {
    /// The choice between two slots.
    pub(super) fn of(slots: &[SlotState; 2]) -> Self {
        let [a, b] = [&slots[0], &slots[1]];
        let (best, other) = if a.usable() >= b.usable() { (a, b) } else { (b, a) };
        let slot = best.slot;
        match best.usable() {
            None => Self::Defaults,
            Some(sequence) if other.may_be_newer_than(sequence) => Self::Other { slot, sequence },
            Some(sequence) => Self::Newest { slot, sequence },
        }
    }

    /// The slot in force.
    pub fn slot(&self) -> Option<Slot> {
        match *self {
            Self::Newest { slot, .. } | Self::Other { slot, .. } => Some(slot),
            Self::Defaults => None,
        }
    }
}

impl Display for SlotState {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "{} at 0x{:08X} ", self.slot, self.address)?;
        match (self.content, self.refused) {
            (Content::Blank, _) => write!(f, "is empty"),
            (Content::Unfinished { .. }, _) => write!(f, "holds an unfinished block"),
            (Content::Damaged { .. }, _) => write!(f, "holds a damaged block"),
            (Content::Unreadable, _) => write!(f, "cannot be read"),
            (Content::Valid { sequence, .. }, None) => write!(f, "holds block {sequence}"),
            (Content::Valid { sequence, .. }, Some(why)) => {
                write!(f, "holds block {sequence}, which is refused: {why}")
            }
        }
    }
}

impl Display for Boot {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let [a, b] = &self.slots;
        match self.source {
            Source::Newest { slot, sequence } => {
                write!(f, "parameters: block {sequence} of {slot}, the newest")
            }
            Source::Other { slot, sequence } => {
                let other = &self.slots[slot.other().index()];
                write!(f, "parameters: block {sequence} of {slot}, because {other}")
            }
            Source::Defaults => write!(f, "parameters: safe defaults, because {a} and {b}"),
        }
    }
}
