//! A firmware image: what the linker wrote for a board.

use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use object::elf::{SHF_ALLOC, SHF_WRITE, SHT_NOBITS, SectionFlags, SectionType};
use object::read::elf::{ElfFile32, SectionHeader};

/// An ELF file in memory.
pub struct Image {
    path: PathBuf,
    bytes: Vec<u8>,
}

/// What an image takes of its chip, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sizes {
    /// Code, constants and the initial values of variables.
    pub flash: u64,
    /// Variables, without the stack.
    pub static_ram: u64,
}

impl Image {
    /// Reads a file into memory.
    pub fn read(path: &Path) -> Result<Self> {
        let bytes = fs::read(path).with_context(|| format!("cannot read {}", path.display()))?;
        Ok(Self { path: path.to_owned(), bytes })
    }

    /// Where the file is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The file's parts.
    pub fn elf(&self) -> Result<ElfFile32<'_>> {
        ElfFile32::parse(self.bytes.as_slice())
            .with_context(|| format!("{} is no 32-bit ELF file", self.path.display()))
    }

    /// Adds up the sections that are loaded or reserved on the chip.
    pub fn sizes(&self) -> Result<Sizes> {
        let elf = self.elf()?;
        let endian = elf.endian();
        let mut sizes = Sizes::default();
        for section in elf.elf_section_table().iter() {
            let size = u64::from(section.sh_size(endian));
            sizes.add(section.sh_flags(endian), section.sh_type(endian), size);
        }
        Ok(sizes)
    }
}

impl Sizes {
    /// Whether nothing is above its limit.
    pub fn fit(self, limits: Self) -> bool {
        self.flash <= limits.flash && self.static_ram <= limits.static_ram
    }

    /// Initialised variables count twice: in RAM, and in flash with their first values.
    fn add(&mut self, flags: SectionFlags, kind: SectionType, size: u64) {
        if !flags.contains(SHF_ALLOC) {
            return;
        }
        if kind != SHT_NOBITS {
            self.flash += size;
        }
        if flags.contains(SHF_WRITE) {
            self.static_ram += size;
        }
    }
}

impl fmt::Display for Sizes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "flash {}, static RAM {}", Kib(self.flash), Kib(self.static_ram))
    }
}

struct Kib(u64);

impl fmt::Display for Kib {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} B ({:.1} KiB)", self.0, self.0 as f64 / 1024.0)
    }
}

#[cfg(test)]
mod tests {
    use object::elf::{SHF_EXECINSTR, SHT_PROGBITS};

    use super::*;

    #[test]
    fn text_takes_flash_data_takes_both_bss_takes_ram_and_debug_neither() {
        let mut sizes = Sizes::default();
        sizes.add(SHF_ALLOC | SHF_EXECINSTR, SHT_PROGBITS, 1000);
        sizes.add(SHF_ALLOC | SHF_WRITE, SHT_PROGBITS, 10);
        sizes.add(SHF_ALLOC | SHF_WRITE, SHT_NOBITS, 200);
        sizes.add(SectionFlags(0), SHT_PROGBITS, 5000);
        assert_eq!(sizes, Sizes { flash: 1010, static_ram: 210 });
    }

    #[test]
    fn an_image_of_exactly_the_limit_fits() {
        let limits = Sizes { flash: 1024, static_ram: 64 };
        assert!(limits.fit(limits));
        assert!(!Sizes { flash: 1025, ..limits }.fit(limits));
        assert!(!Sizes { static_ram: 65, ..limits }.fit(limits));
    }
}
