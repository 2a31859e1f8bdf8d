//! The image as the linker wrote it: bytes for the flash, and where its symbols are.

use std::path::{Path, PathBuf};

use object::elf::PT_LOAD;
use object::read::elf::{ElfFile32, ProgramHeader};
use object::{Endianness, Object, ObjectSymbol};

use crate::failure::Failure;
use crate::memory_map::{FLASH_BYTES, FLASH_START};

/// An image in the flash, before the first power-on.
#[derive(Clone)]
pub struct Image {
    /// All of the flash; erased where the image says nothing.
    pub flash: Vec<u8>,
    symbols: Vec<(String, u32)>,
}

impl Image {
    /// Reads an ELF file for the board.
    ///
    /// # Errors
    /// It cannot be read, is no 32-bit ELF file, or has bytes outside the flash.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let bad = |why: String| Failure::Image { path: PathBuf::from(path), why };
        let bytes = std::fs::read(path).map_err(|error| bad(error.to_string()))?;
        let elf: ElfFile32<'_, Endianness> =
            ElfFile32::parse(bytes.as_slice()).map_err(|error| bad(error.to_string()))?;
        let mut flash = vec![0xFF; FLASH_BYTES];
        for header in elf.elf_program_headers() {
            let endian = elf.endian();
            if header.p_type(endian) == PT_LOAD {
                let data = header.data(endian, bytes.as_slice());
                let data = data.map_err(|()| bad("a segment is cut off".to_owned()))?;
                put(&mut flash, header.p_paddr(endian), data)
                    .ok_or_else(|| bad("a segment lies outside the flash".to_owned()))?;
            }
        }
        let named = |s: object::read::elf::ElfSymbol32<'_, '_>| {
            Some((s.name().ok()?.to_owned(), s.address() as u32))
        };
        Ok(Self { flash, symbols: elf.symbols().filter_map(named).collect() })
    }

    /// Where a symbol is whose name contains all of the parts.
    pub fn symbol(&self, parts: &[&str]) -> Option<u32> {
        let has_all = |name: &str| parts.iter().all(|part| name.contains(part));
        self.symbols.iter().find(|(name, _)| has_all(name)).map(|(_, address)| *address)
    }

    /// The same image with another byte at a symbol; `None` where it has no such symbol.
    pub fn with_byte(&self, symbol: &str, byte: u8) -> Option<Self> {
        let at = self.symbol(&[symbol])?.checked_sub(FLASH_START)? as usize;
        let mut image = self.clone();
        *image.flash.get_mut(at)? = byte;
        Some(image)
    }

    /// The symbol at an address or the nearest below it, for messages.
    pub fn place(&self, address: u32) -> String {
        let address = address & !1;
        let below = self
            .symbols
            .iter()
            .filter(|(name, at)| !name.starts_with('$') && !name.is_empty() && at & !1 <= address);
        below
            .max_by_key(|(_, at)| at & !1)
            .map_or_else(String::new, |(name, at)| format!("{name}+{:#x}", address - (at & !1)))
    }
}

fn put(flash: &mut [u8], address: u32, data: &[u8]) -> Option<()> {
    if !data.is_empty() {
        let start = address.checked_sub(FLASH_START)? as usize;
        flash.get_mut(start..start.checked_add(data.len())?)?.copy_from_slice(data);
    }
    Some(())
}
