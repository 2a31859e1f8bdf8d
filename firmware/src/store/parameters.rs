//! The parameter block in its two slots.

use embedded_storage::nor_flash::NorFlash;

use super::boot::{Boot, SlotState, Source};
use super::defaults::safe_defaults;
use super::error::StoreError;
use super::flash::Store;
use super::layout::{Kind, Slot};
use super::read::{Content, Stored};
use super::record::BODY_ROOM;
use crate::block::{BlockError, HardLimits, MAX_BYTES, ParameterBlock};

impl<F: NorFlash> Store<F> {
    /// The parameters that a board boots with, where they come from, and why.
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
            Content::Valid { length, .. } => decode(&body, length).err(),
            _ => None,
        };
        SlotState { slot, address: place.address, content, refused }
    }

    fn block(&mut self, slot: Slot) -> Option<ParameterBlock> {
        let place = self.place(Kind::Parameters, slot, 0);
        let mut body = [0; BODY_ROOM];
        match self.content(place, &mut body) {
            Content::Valid { length, .. } => decode(&body, length).ok(),
            _ => None,
        }
    }
}

fn decode(body: &[u8], length: usize) -> Result<ParameterBlock, BlockError> {
    usable(body.get(..length).unwrap_or_default())
}

/// The block in these bytes, if a board may use it, however it came into the store.
fn usable(encoded: &[u8]) -> Result<ParameterBlock, BlockError> {
    let block = ParameterBlock::decode(encoded)?;
    HardLimits::of_rig().check(&block)?;
    Ok(block)
}

fn is_usable(body: &[u8]) -> bool {
    usable(body).is_ok()
}
