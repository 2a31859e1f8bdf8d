//! A parameter block as the record that the board finds in a slot.

use firmware::ParameterBlock;
use firmware::block::MAX_BYTES;
use firmware::store::{Layout, RamFlash, Slot, Store, slot_record};

use super::check::slot_addresses;
use super::{FlashError, FlashImage, Piece};

const LAYOUT: Layout = Layout::G474;

impl FlashImage {
    /// The block in a slot, to the end of its page: the higher its sequence number, the newer.
    ///
    /// # Errors
    /// The board would refuse the block, or the slot has no room for it.
    pub fn of_block(block: &ParameterBlock, slot: Slot, sequence: u32) -> Result<Self, FlashError> {
        let mut buffer = [0; MAX_BYTES];
        let encoded = block.encode(&mut buffer)?;
        ParameterBlock::decode(encoded)?;
        let pages = slot_addresses(slot);
        let mut bytes = vec![0xFF; (pages.end - pages.start) as usize];
        let too_long = FlashError::TooLong { bytes: encoded.len() };
        let used = slot_record(sequence, encoded, &mut bytes).ok_or(too_long)?.len();
        bytes.truncate(used);
        Ok(Self { pieces: vec![Piece { address: LAYOUT.slot(slot), bytes }] })
    }
}

/// The slot where the board's next block goes, and its sequence number.
///
/// `bank` is what the board has from the begin of bank 2 on, [`Layout::used_bytes`].
///
/// # Errors
/// No sequence number is left.
pub fn next_slot(bank: Vec<u8>) -> Result<(Slot, u32), FlashError> {
    let mut store = Store::new(RamFlash::new(bank), LAYOUT.bank_start, LAYOUT);
    store.next_place().ok_or(FlashError::WornOut)
}
