//! Memory that behaves like the G474's flash: for the emulated board and for tests.

use embedded_storage::nor_flash::{
    ErrorType, NorFlash, NorFlashErrorKind, ReadNorFlash, check_erase, check_read, check_write,
};

use super::layout::Layout;
use super::record::WORD_BYTES;

/// Erasing makes ones; a word of 8 bytes is written once between two erasures.
#[derive(Clone, Debug)]
pub struct RamFlash<B> {
    bytes: B,
}

impl<B: AsRef<[u8]> + AsMut<[u8]>> RamFlash<B> {
    /// Flash with this content; whole pages.
    pub fn new(bytes: B) -> Self {
        Self { bytes }
    }

    /// What it holds.
    pub fn bytes(&self) -> &[u8] {
        self.bytes.as_ref()
    }

    /// What it holds, to be changed against the rules.
    pub fn bytes_mut(&mut self) -> &mut [u8] {
        self.bytes.as_mut()
    }
}

impl<B> ErrorType for RamFlash<B> {
    type Error = NorFlashErrorKind;
}

impl<B: AsRef<[u8]> + AsMut<[u8]>> ReadNorFlash for RamFlash<B> {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Self::Error> {
        check_read(self, offset, bytes.len())?;
        let from = self.bytes().iter().skip(offset as usize);
        for (to, from) in bytes.iter_mut().zip(from) {
            *to = *from;
        }
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.bytes().len()
    }
}

impl<B: AsRef<[u8]> + AsMut<[u8]>> NorFlash for RamFlash<B> {
    const WRITE_SIZE: usize = WORD_BYTES;
    const ERASE_SIZE: usize = Layout::G474.page_bytes as usize;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Self::Error> {
        check_erase(self, from, to)?;
        let page = self.bytes_mut().get_mut(from as usize..to as usize);
        page.ok_or(NorFlashErrorKind::OutOfBounds)?.fill(0xFF);
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Self::Error> {
        check_write(self, offset, bytes.len())?;
        let words = self.bytes_mut().iter_mut().skip(offset as usize).zip(bytes);
        let mut blank = true;
        for (to, from) in words {
            blank &= *to == 0xFF;
            *to &= from;
        }
        if blank { Ok(()) } else { Err(NorFlashErrorKind::Other) }
    }
}
