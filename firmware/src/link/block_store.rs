//! What the command handler stores without power, and how it lies in the flash.

use embedded_storage::nor_flash::NorFlash;

use super::answer::StoreRefusal;
use super::key::Key;
use crate::block::MAX_BYTES;
use crate::store::{Kind, NOTE_BYTES, Store};
use crate::supervisor::{Fault, FaultRecord};

/// Raised when [`FaultRecord`] changes.
const FAULT_LAYOUT: u8 = 1;
/// A fault was stored by a firmware that writes it differently: it is latched all the same.
const UNREADABLE_FAULT: FaultRecord =
    FaultRecord { fault: Fault::CorruptParameters, joint: 0, tick: 0, value: 0.0, limit: 0.0 };

/// The parameter block, the latched fault and the key, which outlast a loss of power.
pub trait BlockStore {
    /// Stores an encoded block beside the newest one, reads it back, then makes it the newest.
    fn commit(&mut self, encoded: &[u8]) -> Result<(), StoreRefusal>;
    /// Copies the newest valid block into `buffer`, returns its bytes.
    fn load<'b>(&mut self, buffer: &'b mut [u8; MAX_BYTES]) -> Result<&'b [u8], StoreRefusal>;
    /// Stores the latched fault over a reset; `None`: there is none any more.
    fn store_fault(&mut self, fault: Option<&FaultRecord>) -> Result<(), StoreRefusal>;
    /// Stores the key; `None`: there is none any more.
    fn store_key(&mut self, key: Option<&Key>) -> Result<(), StoreRefusal>;
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

    fn store_fault(&mut self, fault: Option<&FaultRecord>) -> Result<(), StoreRefusal> {
        let mut buffer = [0; NOTE_BYTES];
        let mut length = 0;
        if let Some(fault) = fault {
            let (layout, record) = buffer.split_at_mut(1);
            layout.fill(FAULT_LAYOUT);
            let written = postcard::to_slice(fault, record).map_err(|_| StoreRefusal::TooLong)?;
            length = 1 + written.len();
        }
        self.write_note(Kind::Fault, buffer.get(..length).unwrap_or_default())?;
        Ok(())
    }

    fn store_key(&mut self, key: Option<&Key>) -> Result<(), StoreRefusal> {
        self.write_note(Kind::Key, key.map_or(&[], |key| key))?;
        Ok(())
    }
}

/// The fault in a record of the store; none in an empty one.
pub(super) fn decode_fault(bytes: &[u8]) -> Option<FaultRecord> {
    let (&layout, record) = bytes.split_first()?;
    let known = (layout == FAULT_LAYOUT).then(|| postcard::from_bytes(record).ok()).flatten();
    Some(known.unwrap_or(UNREADABLE_FAULT))
}
