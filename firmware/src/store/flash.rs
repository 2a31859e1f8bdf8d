//! The store and its flash: addresses, and reading, writing and erasing at them.

use embedded_storage::nor_flash::{NorFlash, NorFlashError};

use super::error::{Operation, Place, StoreError};
use super::layout::{Kind, Layout, Slot};
use super::record::WORD_BYTES;

/// The store in a flash.
#[derive(Debug)]
pub struct Store<F> {
    flash: F,
    origin: u32,
    pub(super) layout: Layout,
}

impl<F: NorFlash> Store<F> {
    const FITS: () = assert!(WORD_BYTES.is_multiple_of(F::WRITE_SIZE));

    /// The store in `flash`, whose offset 0 lies at the address `origin`.
    ///
    /// The flash is written in words that divide 8 bytes, and erased in pieces that divide the
    /// layout's page.
    pub fn new(flash: F, origin: u32, layout: Layout) -> Self {
        let () = Self::FITS;
        Self { flash, origin, layout }
    }

    /// The flash, for what must be done with it otherwise.
    pub fn into_flash(self) -> F {
        self.flash
    }

    pub(super) fn place(&self, kind: Kind, slot: Slot, index: u32) -> Place {
        let page = self.layout.pages(kind)[slot.index()];
        Place { kind, slot, address: page + index * self.layout.place_bytes(kind) }
    }

    pub(super) fn places_per_page(&self, kind: Kind) -> u32 {
        self.layout.page_bytes / self.layout.place_bytes(kind)
    }

    /// Reads from `at` bytes behind a place.
    pub(super) fn read(
        &mut self,
        place: Place,
        at: usize,
        bytes: &mut [u8],
    ) -> Result<(), StoreError> {
        let offset = place.address - self.origin + at as u32;
        self.flash.read(offset, bytes).map_err(|error| StoreError::Flash {
            operation: Operation::Read,
            place,
            kind: error.kind(),
        })
    }

    pub(super) fn erase(&mut self, place: Place) -> Result<(), StoreError> {
        let from = place.address - self.origin;
        self.flash.erase(from, from + self.layout.page_bytes).map_err(|error| StoreError::Flash {
            operation: Operation::Erase,
            place,
            kind: error.kind(),
        })
    }

    pub(super) fn write(
        &mut self,
        place: Place,
        at: usize,
        bytes: &[u8],
    ) -> Result<(), StoreError> {
        let offset = place.address - self.origin + at as u32;
        self.flash.write(offset, bytes).map_err(|error| StoreError::Flash {
            operation: Operation::Write,
            place,
            kind: error.kind(),
        })
    }
}
