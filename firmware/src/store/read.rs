//! Reading records: what a place holds, and which one is the newest.

use embedded_storage::nor_flash::NorFlash;

use super::error::{Place, StoreError};
use super::flash::Store;
use super::layout::{Kind, Slot};
use super::record::{BODY_AT, BODY_ROOM, HEADER_BYTES, Header, WORD_BYTES, marked, whole_words};

/// What a place holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// Ones.
    Blank,
    /// A record without its mark: the power failed while it was written, or the mark is damaged.
    Unfinished {
        /// The sequence number that it seems to have.
        claim: Option<u32>,
    },
    /// A record that does not fit its checksum.
    Damaged {
        /// The sequence number that it seems to have.
        claim: Option<u32>,
    },
    /// The flash reports an error where it lies.
    Unreadable,
    /// A record.
    Valid {
        /// Its sequence number.
        sequence: u32,
        /// Its length [bytes].
        length: usize,
    },
}

/// A record that was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stored {
    /// The slot, or which of the two pages.
    pub slot: Slot,
    /// Its number within the page.
    pub(super) index: u32,
    /// The higher, the newer.
    pub sequence: u32,
    /// Its length [bytes].
    pub length: usize,
}

/// All that is known about a pair of pages.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Survey {
    /// The newest record that is accepted.
    pub newest: Option<Stored>,
    /// The highest sequence number of each page, accepted or not.
    pub highest: [Option<u32>; 2],
}

impl<F: NorFlash> Store<F> {
    /// What a place holds; its body goes into `body`.
    pub(super) fn content(&mut self, place: Place, body: &mut [u8; BODY_ROOM]) -> Content {
        self.try_content(place, body).unwrap_or(Content::Unreadable)
    }

    fn try_content(
        &mut self,
        place: Place,
        body: &mut [u8; BODY_ROOM],
    ) -> Result<Content, StoreError> {
        let mut head = [0; HEADER_BYTES];
        self.read(place, 0, &mut head)?;
        let mut mark = [0; WORD_BYTES];
        self.read(place, HEADER_BYTES, &mut mark)?;
        let header = Header::decode(place.kind, &head);
        let sequence = marked(&mark);
        let claim = sequence.or(header.map(|header| header.sequence));
        let Some(sequence) = sequence else {
            let blank = claim.is_none() && self.is_blank(place)?;
            return Ok(if blank { Content::Blank } else { Content::Unfinished { claim } });
        };
        let Some(header) = header.filter(|header| header.sequence == sequence) else {
            return Ok(Content::Damaged { claim });
        };
        let length = usize::from(header.length);
        let Some(filled) = body.get_mut(..whole_words(length)) else {
            return Ok(Content::Damaged { claim });
        };
        self.read(place, BODY_AT, filled)?;
        Ok(match header.fits(place.kind, filled) {
            true => Content::Valid { sequence, length },
            false => Content::Damaged { claim },
        })
    }

    fn is_blank(&mut self, place: Place) -> Result<bool, StoreError> {
        let mut word = [0; WORD_BYTES];
        for at in (0..self.layout.place_bytes(place.kind) as usize).step_by(WORD_BYTES) {
            self.read(place, at, &mut word)?;
            if word != [0xFF; WORD_BYTES] {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Looks at every place of a kind; `accept` says which valid records count.
    pub(super) fn survey(&mut self, kind: Kind, accept: fn(&[u8]) -> bool) -> Survey {
        let mut survey = Survey::default();
        let mut body = [0; BODY_ROOM];
        for slot in Slot::BOTH {
            for index in 0..self.places_per_page(kind) {
                let place = self.place(kind, slot, index);
                if let Content::Valid { sequence, length } = self.content(place, &mut body) {
                    let accepted = body.get(..length).is_some_and(accept);
                    survey.add(Stored { slot, index, sequence, length }, accepted);
                }
            }
        }
        survey
    }

    /// Reads a record's body again, into the first bytes of `buffer`.
    pub(super) fn reread(
        &mut self,
        kind: Kind,
        stored: Stored,
        buffer: &mut [u8],
    ) -> Option<Stored> {
        let place = self.place(kind, stored.slot, stored.index);
        let bytes = buffer.get_mut(..stored.length)?;
        self.read(place, BODY_AT, bytes).ok()?;
        Some(stored)
    }
}

impl Survey {
    fn add(&mut self, found: Stored, accepted: bool) {
        let highest = &mut self.highest[found.slot.index()];
        *highest = (*highest).max(Some(found.sequence));
        if accepted && self.newest.is_none_or(|newest| newest.sequence < found.sequence) {
            self.newest = Some(found);
        }
    }

    /// The page that may be erased: never that of the newest record.
    pub fn page_to_erase(&self) -> Slot {
        match self.newest {
            Some(newest) => newest.slot.other(),
            None if self.highest[0] <= self.highest[1] => Slot::A,
            None => Slot::B,
        }
    }

    /// The sequence number of the next record, if there is one left.
    pub fn next_sequence(&self) -> Option<u32> {
        self.highest[0].max(self.highest[1]).map_or(Some(1), |highest| highest.checked_add(1))
    }
}
