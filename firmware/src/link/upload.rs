//! Reception of a parameter block in pieces, beside the one in use.

use heapless::Vec;

use super::answer::{BlockRefusal, Refusal};
use crate::block::MAX_BYTES;
use crate::checksum::CRC_32C;

/// An encoded block.
pub type Block = Vec<u8, MAX_BYTES>;

/// The pieces received so far.
#[derive(Debug, Default)]
pub struct Upload {
    announced: Option<Announced>,
    bytes: Block,
}

#[derive(Clone, Copy, Debug)]
struct Announced {
    length: u16,
    checksum: u32,
}

impl Upload {
    /// Begins an upload, in place of an unfinished one.
    pub fn begin(&mut self, length: u16, checksum: u32) -> Result<(), BlockRefusal> {
        if usize::from(length) > MAX_BYTES {
            return Err(BlockRefusal::Length);
        }
        self.bytes.clear();
        self.announced = Some(Announced { length, checksum });
        Ok(())
    }

    /// Takes the piece that follows.
    pub fn add(&mut self, offset: u16, bytes: &[u8]) -> Result<(), Refusal> {
        let taken = self.bytes.len();
        let announced = self.announced.map_or(0, |announced| usize::from(announced.length));
        let follows = usize::from(offset) == taken && taken + bytes.len() <= announced;
        match follows && self.bytes.extend_from_slice(bytes).is_ok() {
            true => Ok(()),
            false => Err(Refusal::Upload { taken: taken as u16 }),
        }
    }

    /// The complete block, if length and checksum are those announced.
    pub fn complete(&self) -> Result<&[u8], BlockRefusal> {
        let announced = self.announced.ok_or(BlockRefusal::Length)?;
        if self.bytes.len() != usize::from(announced.length) {
            return Err(BlockRefusal::Length);
        }
        match CRC_32C.checksum(&self.bytes) == announced.checksum {
            true => Ok(&self.bytes),
            false => Err(BlockRefusal::Checksum),
        }
    }
}
