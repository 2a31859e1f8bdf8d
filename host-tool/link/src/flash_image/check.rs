//! What may be written where: bank 1 is the firmware's; in bank 2 one slot, and nothing else.
//! Afterwards all else in bank 2 must be what it was.

use std::ops::Range;

use firmware::store::{Kind, Layout, Slot};

use super::{FlashError, FlashImage, Piece};

const LAYOUT: Layout = Layout::G474;
/// The chip's flash.
pub const FLASH: Range<u64> = 0x0800_0000..0x0808_0000;

impl FlashImage {
    /// Checks every piece against the memory map.
    ///
    /// # Errors
    /// The first piece outside flash, or in bank 2 outside the slot chosen; two pieces that
    /// overlap.
    pub fn check(&self, chosen: Option<Slot>) -> Result<(), FlashError> {
        self.pieces.iter().try_for_each(|piece| check_piece(piece, chosen))?;
        check_overlap(&self.pieces)
    }
}

fn check_piece(piece: &Piece, chosen: Option<Slot>) -> Result<(), FlashError> {
    let (address, end) = (piece.address, piece.end());
    if u64::from(address) < FLASH.start || end > FLASH.end {
        return Err(FlashError::NotFlash { address, end });
    }
    let in_slot = chosen.is_some_and(|slot| {
        let pages = slot_addresses(slot);
        pages.start <= u64::from(address) && end <= pages.end
    });
    if end > u64::from(LAYOUT.bank_start) && !in_slot {
        return Err(FlashError::NotTheSlot { address, end, chosen });
    }
    Ok(())
}

/// The addresses of a slot.
pub fn slot_addresses(slot: Slot) -> Range<u64> {
    let start = u64::from(LAYOUT.slot(slot));
    start..start + u64::from(LAYOUT.page_bytes)
}

/// Compares bank 2, [`Layout::used_bytes`] from its begin on, before and after an image was
/// written: all but the pages that the image is in, faults and keys too.
///
/// # Errors
/// The first byte that has changed.
pub fn unchanged(before: &[u8], after: &[u8], image: &FlashImage) -> Result<(), FlashError> {
    for offset in 0..LAYOUT.used_bytes() {
        let address = LAYOUT.bank_start + offset;
        let at = offset as usize;
        if before.get(at) != after.get(at) && !is_page_of(image, address) {
            return Err(FlashError::OthersChanged { address, place: place(address) });
        }
    }
    Ok(())
}

/// Whether the image has bytes in the page of an address.
fn is_page_of(image: &FlashImage, address: u32) -> bool {
    let start = u64::from(address - address % LAYOUT.page_bytes);
    let end = start + u64::from(LAYOUT.page_bytes);
    image.pieces.iter().any(|piece| u64::from(piece.address) < end && start < piece.end())
}

/// What is kept in the page of an address, in words.
fn place(address: u32) -> String {
    let page = address - address % LAYOUT.page_bytes;
    let kept = Kind::ALL.into_iter().find_map(|kind| {
        let index = LAYOUT.pages(kind).into_iter().position(|start| start == page)?;
        Some(format!("the {}, {}", kind.name(), Slot::BOTH[index]))
    });
    kept.unwrap_or_else(|| "an empty page of bank 2".to_owned())
}

fn check_overlap(pieces: &[Piece]) -> Result<(), FlashError> {
    let mut in_order: Vec<&Piece> = pieces.iter().collect();
    in_order.sort_by_key(|piece| piece.address);
    let clash = in_order.windows(2).find(|pair| pair[0].end() > u64::from(pair[1].address));
    match clash {
        Some(pair) => Err(FlashError::Overlap { address: pair[1].address }),
        None => Ok(()),
    }
}
