//! Bank 2 of the flash, in memory, written through to `flash.bin` in QEMU's working directory.
//!
//! Every word is in the file before the next one is begun, so QEMU can be killed at any
//! moment and finds what it had written when it starts again.

use core::ffi::CStr;

use cortex_m::singleton;
use embedded_storage::nor_flash::{ErrorType, NorFlash, NorFlashErrorKind, ReadNorFlash};
use firmware::store::{Layout, RamFlash, Store};

use crate::host_file::{HostFile, Mode};

const LAYOUT: Layout = Layout::G474;
const BYTES: usize = LAYOUT.used_bytes() as usize;
const WORD_BYTES: usize = 8;
/// As on the G474, a commit is mostly waiting for the flash, so who pulls the plug hits it there.
const CYCLES_PER_WORD: u32 = 10_000;
/// What outlives QEMU.
const FILE: &CStr = c"flash.bin";

/// Flash that a file remembers.
pub struct FileFlash {
    memory: RamFlash<&'static mut [u8; BYTES]>,
    file: HostFile,
}

/// The board's store; `None` where no file can be written, or the second time.
pub fn store() -> Option<Store<FileFlash>> {
    Some(Store::new(FileFlash::open()?, LAYOUT.bank_start, LAYOUT))
}

impl FileFlash {
    /// The flash as the file has it; all ones where there is none yet.
    fn open() -> Option<Self> {
        let bytes = singleton!(: [u8; BYTES] = [0xFF; BYTES])?;
        if let Some(mut file) = HostFile::open(FILE, Mode::ReadWrite) {
            file.read(bytes)?;
            return Some(Self { memory: RamFlash::new(bytes), file });
        }
        let mut file = HostFile::open(FILE, Mode::CreateReadWrite)?;
        file.write(bytes)?;
        Some(Self { memory: RamFlash::new(bytes), file })
    }

    /// Puts these bytes of the memory into the file, word by word.
    fn write_through(&mut self, from: u32, length: usize) -> Result<(), NorFlashErrorKind> {
        let mut word = [0; WORD_BYTES];
        for at in (from..from + length as u32).step_by(WORD_BYTES) {
            cortex_m::asm::delay(CYCLES_PER_WORD);
            self.memory.read(at, &mut word)?;
            let written = self.file.seek(at).and_then(|()| self.file.write(&word));
            written.ok_or(NorFlashErrorKind::Other)?;
        }
        Ok(())
    }
}

impl ErrorType for FileFlash {
    type Error = NorFlashErrorKind;
}

impl ReadNorFlash for FileFlash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Self::Error> {
        self.memory.read(offset, bytes)
    }

    fn capacity(&self) -> usize {
        BYTES
    }
}

impl NorFlash for FileFlash {
    const WRITE_SIZE: usize = WORD_BYTES;
    const ERASE_SIZE: usize = LAYOUT.page_bytes as usize;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Self::Error> {
        self.memory.erase(from, to)?;
        self.write_through(from, (to - from) as usize)
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Self::Error> {
        self.memory.write(offset, bytes)?;
        self.write_through(offset, bytes.len())
    }
}
