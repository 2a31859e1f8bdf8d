//! The small records: the latched fault and the key.

use embedded_storage::nor_flash::NorFlash;

use super::error::StoreError;
use super::flash::Store;
use super::layout::Kind;
use super::record::NOTE_BYTES;

impl<F: NorFlash> Store<F> {
    /// Reads the latched fault or the key as it was last written, returns its length; 0 if it
    /// was removed.
    pub fn read_note(&mut self, kind: Kind, buffer: &mut [u8; NOTE_BYTES]) -> Option<usize> {
        let stored = self.survey(kind, |_| true).newest?;
        self.reread(kind, stored, buffer).map(|stored| stored.length)
    }

    /// Writes the latched fault or the key, at most [`NOTE_BYTES`]; an empty note removes it.
    ///
    /// Mostly one write of less than 1 ms. Once in 32 times a page is erased (25 ms).
    ///
    /// # Errors
    /// The flash does not take it; the last one is still there.
    pub fn write_note(&mut self, kind: Kind, note: &[u8]) -> Result<(), StoreError> {
        if note.len() > NOTE_BYTES {
            let bytes = note.len();
            return Err(StoreError::TooLong { kind, bytes, room: NOTE_BYTES });
        }
        let survey = self.survey(kind, |_| true);
        self.append(kind, note, &survey).map(drop)
    }
}
