//! The RAM, for the DMA.

use unicorn_engine::Unicorn;

use crate::advance::Memory;
use crate::memory_map::{RAM_BYTES, RAM_START};

/// The RAM, for the DMA.
pub struct Ram<'a>(pub &'a mut Unicorn<'static, ()>);

impl Memory for Ram<'_> {
    fn read(&mut self, address: u32) -> Option<u8> {
        let mut byte = [0];
        self.0.mem_read(u64::from(address), &mut byte).ok()?;
        Some(byte[0])
    }

    fn write(&mut self, address: u32, byte: u8) -> bool {
        let end = RAM_START + RAM_BYTES as u32;
        (RAM_START..end).contains(&address) && self.0.mem_write(u64::from(address), &[byte]).is_ok()
    }
}
