//! The firmware's file, as the linker wrote it.

use std::path::Path;

use object::elf::PT_LOAD;
use object::read::elf::{ElfFile32, ProgramHeader};

use super::{FlashError, FlashImage, Piece};

impl FlashImage {
    /// What an ELF file puts into flash.
    ///
    /// # Errors
    /// The bytes are no such file, or nothing of it is loaded. `path` is for the message.
    pub fn of_elf(path: &Path, bytes: &[u8]) -> Result<Self, FlashError> {
        let not_elf = |error: object::read::Error| FlashError::NotElf {
            path: path.to_owned(),
            why: error.to_string(),
        };
        let elf: ElfFile32<'_> = ElfFile32::parse(bytes).map_err(not_elf)?;
        let endian = elf.endian();
        let loaded = elf
            .elf_program_headers()
            .iter()
            .filter(|header| header.p_type(endian) == PT_LOAD && header.p_filesz(endian) > 0);
        let pieces: Vec<Piece> = loaded
            .map(|header| {
                let content = header.data(endian, bytes).map_err(|()| FlashError::NotElf {
                    path: path.to_owned(),
                    why: "a segment lies beyond its end".into(),
                })?;
                Ok(Piece { address: header.p_paddr(endian), bytes: content.to_vec() })
            })
            .collect::<Result<_, FlashError>>()?;
        if pieces.is_empty() {
            return Err(FlashError::NoProgram { path: path.to_owned() });
        }
        Ok(Self { pieces })
    }
}
