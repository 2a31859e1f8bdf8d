//! Writing a record: never over the newest one, read back, and only then marked.

use embedded_storage::nor_flash::NorFlash;

use super::error::{Place, StoreError};
use super::flash::Store;
use super::layout::{Kind, Slot};
use super::read::{Content, Stored, Survey};
use super::record::{BODY_AT, BODY_ROOM, HEADER_BYTES, Header, WORD_BYTES, filled, mark};

impl<F: NorFlash> Store<F> {
    /// Stores a body as the newest record of its kind.
    ///
    /// It goes behind the newest record if there is a blank place; else, or if that place
    /// cannot be written, the other page is erased for it.
    pub(super) fn append(
        &mut self,
        kind: Kind,
        body: &[u8],
        survey: &Survey,
    ) -> Result<Stored, StoreError> {
        let room = self.room(kind);
        if body.len() > room {
            return Err(StoreError::TooLong { kind, bytes: body.len(), room });
        }
        let sequence = survey.next_sequence().ok_or(StoreError::WornOut)?;
        if let Some((slot, index)) = self.blank_place(kind, survey)
            && self.write_record(self.place(kind, slot, index), sequence, body).is_ok()
        {
            return Ok(Stored { slot, index, sequence, length: body.len() });
        }
        let slot = survey.page_to_erase();
        let place = self.place(kind, slot, 0);
        self.erase(place)?;
        self.write_record(place, sequence, body)?;
        Ok(Stored { slot, index: 0, sequence, length: body.len() })
    }

    /// Room for a body [bytes].
    fn room(&self, kind: Kind) -> usize {
        (self.layout.place_bytes(kind) as usize - BODY_AT).min(BODY_ROOM)
    }

    /// The first blank place behind the newest record, in its page.
    fn blank_place(&mut self, kind: Kind, survey: &Survey) -> Option<(Slot, u32)> {
        let newest = survey.newest?;
        let mut body = [0; BODY_ROOM];
        let index = (newest.index + 1..self.places_per_page(kind)).find(|&index| {
            let place = self.place(kind, newest.slot, index);
            self.content(place, &mut body) == Content::Blank
        })?;
        Some((newest.slot, index))
    }

    fn write_record(&mut self, place: Place, sequence: u32, body: &[u8]) -> Result<(), StoreError> {
        let header = Header::of(place.kind, sequence, body).encode(place.kind);
        let (words, rest) = body.split_at(body.len() - body.len() % WORD_BYTES);
        let last = filled(rest);
        let last: &[u8] = if rest.is_empty() { &[] } else { &last };
        let pieces = [(0, &header[..]), (BODY_AT, words), (BODY_AT + words.len(), last)];
        for (at, bytes) in pieces {
            self.write(place, at, bytes)?;
        }
        for (at, bytes) in pieces {
            self.read_back(place, at, bytes)?;
        }
        let mark = mark(sequence);
        self.write(place, HEADER_BYTES, &mark)?;
        self.read_back(place, HEADER_BYTES, &mark)
    }

    fn read_back(&mut self, place: Place, at: usize, bytes: &[u8]) -> Result<(), StoreError> {
        let mut found = [0; WORD_BYTES];
        for (at, word) in (at..).step_by(WORD_BYTES).zip(bytes.chunks_exact(WORD_BYTES)) {
            self.read(place, at, &mut found)?;
            if found != word {
                return Err(StoreError::ReadBack { place });
            }
        }
        Ok(())
    }
}
