//! A store in memory.

use firmware::block::MAX_BYTES;
use firmware::link::{BlockStore, Key, StoreRefusal};
use firmware::supervisor::FaultRecord;

/// What is kept, and how it fails on demand.
#[derive(Debug, Default)]
pub struct MemoryStore {
    pub block: Option<Vec<u8>>,
    pub fault: Option<FaultRecord>,
    pub key: Option<Key>,
    pub commits: u32,
    /// Nothing can be written.
    pub fails: bool,
    /// What is written is not what is read.
    pub lies: bool,
}

impl BlockStore for MemoryStore {
    fn commit(&mut self, encoded: &[u8]) -> Result<(), StoreRefusal> {
        self.writable()?;
        self.commits += 1;
        self.block = Some(encoded.to_vec());
        Ok(())
    }

    fn load<'b>(&mut self, buffer: &'b mut [u8; MAX_BYTES]) -> Result<&'b [u8], StoreRefusal> {
        let block = self.block.as_ref().ok_or(StoreRefusal::Empty)?;
        let buffer = &mut buffer[..block.len()];
        buffer.copy_from_slice(block);
        buffer[7] ^= u8::from(self.lies);
        Ok(buffer)
    }

    fn store_fault(&mut self, fault: Option<&FaultRecord>) -> Result<(), StoreRefusal> {
        self.writable()?;
        self.fault = fault.copied();
        Ok(())
    }

    fn store_key(&mut self, key: Option<&Key>) -> Result<(), StoreRefusal> {
        self.writable()?;
        self.key = key.copied();
        Ok(())
    }
}

impl MemoryStore {
    fn writable(&self) -> Result<(), StoreRefusal> {
        if self.fails { Err(StoreRefusal::Write) } else { Ok(()) }
    }
}
