//! What the board keeps without power: parameters in two slots, the latched fault, the key.
//!
//! Each kind has two pages of flash. A record is written where the newest one is not, read
//! back, and marked as whole last, so that a cut of the power leaves the old one or the new
//! one (`docs/parameter-store.md`). Reading never erases or writes.

mod append;
mod boot;
mod defaults;
mod error;
mod layout;
mod ram;
mod read;
mod record;

use embedded_storage::nor_flash::NorFlash;

pub use boot::{Boot, SlotState, Source};
pub use defaults::safe_defaults;
pub use error::{Operation, Place, StoreError};
pub use layout::{Kind, Layout, Slot};
pub use ram::RamFlash;
pub use read::{Content, Stored};
pub use record::slot_record;

use crate::block::{BlockError, MAX_BYTES, ParameterBlock};
use crate::supervisor::HardLimits;

/// Room for a body in memory: a block, filled up to whole words.
const BODY_ROOM: usize = record::whole_words(MAX_BYTES);
/// Bytes from one small record to the next.
const NOTE_PLACE_BYTES: u32 = 64;
/// No small record (fault or key) is longer [bytes].
pub const NOTE_BYTES: usize = NOTE_PLACE_BYTES as usize - record::BODY_AT;

const _: () = assert!(record::BODY_AT + BODY_ROOM <= Layout::G474.page_bytes as usize);

/// The store in a flash.
#[derive(Debug)]
pub struct Store<F> {
    flash: F,
    origin: u32,
    layout: Layout,
}

impl<F: NorFlash> Store<F> {
    const FITS: () = assert!(record::WORD_BYTES.is_multiple_of(F::WRITE_SIZE));

    /// The store in `flash`, whose offset 0 lies at the address `origin`.
    ///
    /// The flash is written in words that divide 8 bytes, and erased in pieces that divide the
    /// layout's page.
    pub fn new(flash: F, origin: u32, layout: Layout) -> Self {
        let () = Self::FITS;
        Self { flash, origin, layout }
    }

    /// The parameters to begin with, where they come from, and why.
    pub fn boot(&mut self) -> Boot {
        let slots = Slot::BOTH.map(|slot| self.state(slot));
        let source = Source::of(&slots);
        let block = source.slot().and_then(|slot| self.block(slot));
        match block {
            Some(block) => Boot { block, source, slots },
            None => Boot { block: safe_defaults(), source: Source::Defaults, slots },
        }
    }

    /// Stores an encoded block in the slot that is not in force, and puts that one in force.
    ///
    /// # Errors
    /// The block would be refused at power-on, or the flash does not take it. What was in
    /// force still is.
    pub fn commit(&mut self, encoded: &[u8]) -> Result<Stored, StoreError> {
        usable(encoded).map_err(StoreError::Refused)?;
        let survey = self.survey(Kind::Parameters, is_usable);
        self.append(Kind::Parameters, encoded, &survey)
    }

    /// The sequence number of the next block, and the slot where it will go.
    pub fn next_place(&mut self) -> Option<(Slot, u32)> {
        let survey = self.survey(Kind::Parameters, is_usable);
        Some((survey.page_to_erase(), survey.next_sequence()?))
    }

    /// The block in force, encoded as it was committed, in the first bytes of `buffer`.
    pub fn newest(&mut self, buffer: &mut [u8; MAX_BYTES]) -> Option<Stored> {
        let stored = self.survey(Kind::Parameters, is_usable).newest?;
        self.reread(Kind::Parameters, stored, buffer)
    }

    /// What a slot holds.
    pub fn state(&mut self, slot: Slot) -> SlotState {
        let place = self.place(Kind::Parameters, slot, 0);
        let mut body = [0; BODY_ROOM];
        let content = self.content(place, &mut body);
        let refused = match content {
            Content::Whole { length, .. } => decode(&body, length).err(),
            _ => None,
        };
        SlotState { slot, address: place.address, content, refused }
    }

    /// The latched fault or the key, as it was last kept; an empty one has been forgotten.
    pub fn note(&mut self, kind: Kind, buffer: &mut [u8; NOTE_BYTES]) -> Option<usize> {
        let stored = self.survey(kind, |_| true).newest?;
        self.reread(kind, stored, buffer).map(|stored| stored.length)
    }

    /// Keeps the latched fault or the key, at most [`NOTE_BYTES`]; none at all to forget it.
    ///
    /// Mostly one write of less than 1 ms. Once in 32 times a page is erased (25 ms).
    ///
    /// # Errors
    /// The flash does not take it; the last one is still there.
    pub fn keep(&mut self, kind: Kind, note: &[u8]) -> Result<(), StoreError> {
        if note.len() > NOTE_BYTES {
            let bytes = note.len();
            return Err(StoreError::TooLong { kind, bytes, room: NOTE_BYTES });
        }
        let survey = self.survey(kind, |_| true);
        self.append(kind, note, &survey).map(drop)
    }

    /// The flash, for what must be done with it otherwise.
    pub fn into_flash(self) -> F {
        self.flash
    }

    fn block(&mut self, slot: Slot) -> Option<ParameterBlock> {
        let place = self.place(Kind::Parameters, slot, 0);
        let mut body = [0; BODY_ROOM];
        match self.content(place, &mut body) {
            Content::Whole { length, .. } => decode(&body, length).ok(),
            _ => None,
        }
    }

    fn reread(&mut self, kind: Kind, stored: Stored, buffer: &mut [u8]) -> Option<Stored> {
        let place = self.place(kind, stored.slot, stored.index);
        let bytes = buffer.get_mut(..stored.length)?;
        self.read(place, record::BODY_AT, bytes).ok()?;
        Some(stored)
    }
}

fn decode(body: &[u8], length: usize) -> Result<ParameterBlock, BlockError> {
    usable(body.get(..length).unwrap_or_default())
}

/// The block in these bytes, if a board may use it, however it came into the store.
fn usable(encoded: &[u8]) -> Result<ParameterBlock, BlockError> {
    let block = ParameterBlock::decode(encoded)?;
    HardLimits::default().check(&block)?;
    Ok(block)
}

fn is_usable(body: &[u8]) -> bool {
    usable(body).is_ok()
}
