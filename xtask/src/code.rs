//! The functions of an image: their names, their extent and their instructions.

use std::collections::BTreeMap;

use anyhow::{Context, Result, bail};
use object::read::elf::ElfFile32;
use object::{Object, ObjectSection, ObjectSymbol, SectionKind, SymbolKind};

use crate::thumb::{self, Instruction};

/// The machine code of an image.
#[derive(Default)]
pub struct Code<'data> {
    sections: Vec<(u32, &'data [u8])>,
    functions: BTreeMap<u32, Function>,
    /// Where instructions (true) and data among them (false) begin.
    mapping: BTreeMap<u32, bool>,
}

/// A function, by whatever names it has.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Function {
    /// Its names as the source has them, sorted.
    pub names: Vec<String>,
    size: u32,
}

impl Function {
    /// The first of its names.
    pub fn name(&self) -> &str {
        self.names.first().map_or("?", String::as_str)
    }

    /// Whether one of its names is such a name.
    pub fn is_called(&self, is_such: fn(&str) -> bool) -> bool {
        self.names.iter().any(|name| is_such(name))
    }
}

impl<'data> Code<'data> {
    /// Collects the code and the symbols of an image.
    pub fn read(elf: &ElfFile32<'data>) -> Result<Self> {
        let mut code = Self::default();
        for section in elf.sections().filter(|section| section.kind() == SectionKind::Text) {
            code.sections.push((section.address() as u32, section.data()?));
        }
        for symbol in elf.symbols() {
            let (address, name) = (symbol.address() as u32, symbol.name()?);
            match symbol.kind() {
                SymbolKind::Text => code.add_function(address, symbol.size() as u32, name),
                _ => code.add_mapping(address, name),
            }
        }
        Ok(code)
    }

    /// Code at address 0 with functions (address, size, name) and mapping symbols.
    #[cfg(test)]
    pub fn from_parts(
        bytes: &'data [u8],
        functions: &[(u32, u32, &str)],
        mapping: &[(u32, &str)],
    ) -> Self {
        let mut code = Self { sections: vec![(0, bytes)], ..Self::default() };
        functions.iter().for_each(|(address, size, name)| code.add_function(*address, *size, name));
        mapping.iter().for_each(|(address, name)| code.add_mapping(*address, name));
        code
    }

    /// The lowest bit of a function's address says Thumb.
    fn add_function(&mut self, address: u32, size: u32, name: &str) {
        let function = self.functions.entry(address & !1).or_default();
        function.size = function.size.max(size);
        function.names.push(format!("{:#}", rustc_demangle::demangle(name)));
        function.names.sort();
    }

    /// Mapping symbols are `$t` and `$d`, possibly with a suffix after a point.
    fn add_mapping(&mut self, address: u32, name: &str) {
        match name.split('.').next() {
            Some("$t") => self.mapping.insert(address, true),
            Some("$d") => self.mapping.insert(address, false),
            _ => None,
        };
    }

    /// Every function with the address where it begins.
    pub fn functions(&self) -> impl Iterator<Item = (u32, &Function)> {
        self.functions.iter().map(|(&address, function)| (address, function))
    }

    /// Where the function that has this address in it begins.
    pub fn function_at(&self, address: u32) -> Option<u32> {
        let (&start, function) = self.functions.range(..=address).next_back()?;
        (address == start || address - start < function.size).then_some(start)
    }

    /// The function that begins at this address.
    pub fn function(&self, start: u32) -> Option<&Function> {
        self.functions.get(&start)
    }

    /// Every instruction of a function with its address.
    pub fn instructions(&self, start: u32) -> Result<Vec<(u32, Instruction)>> {
        let function = self.function(start).context("no function begins here")?;
        if function.size == 0 {
            bail!("{} has no size in the symbol table", function.name());
        }
        let end = start + function.size;
        let mut instructions = Vec::new();
        let mut address = start;
        while address < end {
            if address != start && !self.is_code(address) {
                address = self.next_mapping(address).unwrap_or(end);
                continue;
            }
            let instruction = self.decode(address)?;
            instructions.push((address, instruction));
            address += instruction.length;
        }
        Ok(instructions)
    }

    fn decode(&self, address: u32) -> Result<Instruction> {
        self.halfword(address)
            .and_then(|first| thumb::decode(address, first, self.halfword(address + 2)))
            .with_context(|| format!("no instruction at {address:#x}"))
    }

    /// Where the data that begin at an address end, as the compiler marks it.
    pub fn end_of_data(&self, address: u32) -> Option<u32> {
        if self.is_code(address) { None } else { self.next_mapping(address) }
    }

    fn is_code(&self, address: u32) -> bool {
        self.mapping.range(..=address).next_back().is_none_or(|(_, &is_code)| is_code)
    }

    fn next_mapping(&self, address: u32) -> Option<u32> {
        self.mapping.range(address + 1..).next().map(|(&next, _)| next)
    }

    /// Where the linker's bridge to a function far away leads: MOVW, MOVT and BX of r12.
    pub fn bridge(&self, start: u32) -> Option<u32> {
        let word = |at: u32| Some((self.halfword(at)?, self.halfword(at + 2)?));
        let immediate = |(first, second): (u16, u16)| {
            let (i, high) = (u32::from(first >> 10 & 1), u32::from(first & 15));
            high << 12 | i << 11 | u32::from(second >> 12 & 7) << 8 | u32::from(second & 0xff)
        };
        let (low, high) = (word(start)?, word(start + 4)?);
        let is_bridge = low.0 & 0xfbf0 == 0xf240
            && high.0 & 0xfbf0 == 0xf2c0
            && [low.1, high.1].iter().all(|second| second >> 8 & 15 == 12)
            && self.halfword(start + 8)? == 0x4760;
        is_bridge.then(|| (immediate(high) << 16 | immediate(low)) & !1)
    }

    /// The halfword at an address.
    pub fn halfword(&self, address: u32) -> Option<u16> {
        self.sections.iter().find_map(|(start, bytes)| {
            let offset = address.checked_sub(*start)? as usize;
            let halfword = bytes.get(offset..offset.checked_add(2)?)?;
            Some(u16::from_le_bytes(halfword.try_into().ok()?))
        })
    }
}
