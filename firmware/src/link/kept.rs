//! The store in flash as the handler wants it, and what a boot finds in it.

use embedded_storage::nor_flash::NorFlash;

use super::answer::{Origin, StoreRefusal};
use super::desk::BlockStore;
use super::key::Key;
use super::upload::Block;
use crate::ParameterBlock;
use crate::block::MAX_BYTES;
use crate::store::{Content, Kind, NOTE_BYTES, Source, Store, StoreError};
use crate::supervisor::{Fault, FaultRecord};

/// Raised when [`FaultRecord`] changes.
const FAULT_LAYOUT: u8 = 1;
/// A fault was kept by a firmware that writes it differently: it is latched all the same.
const UNREADABLE_FAULT: FaultRecord =
    FaultRecord { fault: Fault::CorruptParameters, joint: 0, tick: 0, value: 0.0, limit: 0.0 };

/// What the board begins with.
#[derive(Clone, Debug)]
pub struct Kept {
    /// The block in force; safe defaults if none is stored.
    pub block: ParameterBlock,
    /// The same, encoded.
    pub encoded: Block,
    /// Where it comes from.
    pub origin: Origin,
    /// Parameters were stored, but none of them can be used.
    pub corrupt: bool,
    /// The latched fault.
    pub fault: Option<FaultRecord>,
    /// The key.
    pub key: Option<Key>,
}

impl Kept {
    /// Looks everything up; erases and writes nothing.
    pub fn of<F: NorFlash>(store: &mut Store<F>) -> Self {
        let boot = store.boot();
        let nothing_stored = boot.slots.iter().all(|slot| slot.content == Content::Blank);
        let origin = match boot.source {
            Source::Newest { .. } => Origin::Newest,
            Source::Other { .. } => Origin::Older,
            Source::Defaults => Origin::SafeDefaults,
        };
        Self {
            encoded: encoded(&boot.block),
            block: boot.block,
            origin,
            corrupt: origin == Origin::SafeDefaults && !nothing_stored,
            fault: note(store, Kind::Fault, fault_of),
            key: note(store, Kind::Key, |bytes| bytes.try_into().ok()),
        }
    }
}

/// A block is encoded in one way only, so this is what was stored.
fn encoded(block: &ParameterBlock) -> Block {
    let mut buffer = [0; MAX_BYTES];
    let bytes = block.encode(&mut buffer).unwrap_or_default();
    Block::from_slice(bytes).unwrap_or_default()
}

/// The fault in a record of the store; none in an empty one.
fn fault_of(bytes: &[u8]) -> Option<FaultRecord> {
    let (&layout, record) = bytes.split_first()?;
    let known = (layout == FAULT_LAYOUT).then(|| postcard::from_bytes(record).ok()).flatten();
    Some(known.unwrap_or(UNREADABLE_FAULT))
}

fn note<F: NorFlash, T>(
    store: &mut Store<F>,
    kind: Kind,
    read: impl FnOnce(&[u8]) -> Option<T>,
) -> Option<T> {
    let mut buffer = [0; NOTE_BYTES];
    let length = store.note(kind, &mut buffer)?;
    read(buffer.get(..length)?)
}

impl<F: NorFlash> BlockStore for Store<F> {
    fn commit(&mut self, encoded: &[u8]) -> Result<(), StoreRefusal> {
        Self::commit(self, encoded)?;
        Ok(())
    }

    fn load<'b>(&mut self, buffer: &'b mut [u8; MAX_BYTES]) -> Result<&'b [u8], StoreRefusal> {
        let stored = self.newest(buffer).ok_or(StoreRefusal::Empty)?;
        buffer.get(..stored.length).ok_or(StoreRefusal::TooLong)
    }

    fn keep_fault(&mut self, fault: Option<&FaultRecord>) -> Result<(), StoreRefusal> {
        let mut buffer = [0; NOTE_BYTES];
        let mut length = 0;
        if let Some(fault) = fault {
            let (layout, record) = buffer.split_at_mut(1);
            layout.fill(FAULT_LAYOUT);
            let written = postcard::to_slice(fault, record).map_err(|_| StoreRefusal::TooLong)?;
            length = 1 + written.len();
        }
        self.keep(Kind::Fault, buffer.get(..length).unwrap_or_default())?;
        Ok(())
    }

    fn keep_key(&mut self, key: Option<&Key>) -> Result<(), StoreRefusal> {
        self.keep(Kind::Key, key.map_or(&[], |key| key))?;
        Ok(())
    }
}

impl From<StoreError> for StoreRefusal {
    fn from(error: StoreError) -> Self {
        match error {
            StoreError::ReadBack { .. } => Self::ReadBack,
            StoreError::TooLong { .. } => Self::TooLong,
            StoreError::Flash { .. } | StoreError::Refused(_) | StoreError::WornOut => Self::Write,
        }
    }
}
