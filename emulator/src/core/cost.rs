//! How long instructions take: one cycle each, and what the flash and the pipeline add.
//!
//! The CCM SRAM delivers each at once.
//! The flash delivers 256 bits in 1 + wait states cycles; the instruction cache of 1 KiB holds 32
//! such lines, the one used longest ago makes room (RM0440, 3.3.4). A taken branch refills the
//! pipeline. Left out: wait states of data in the flash, divisions and multiple loads, contention
//! of the buses. So cycles are too few by an estimated 10 to 40 percent.

use crate::memory_map::{CCM_START, FLASH_BYTES};

/// Bytes of a line of the cache.
const LINE_BYTES: u32 = 32;
/// Lines of the cache.
const LINES: usize = 32;
/// Cycles that a taken branch adds; the core takes one to three.
const BRANCH_CYCLES: u64 = 2;

/// The instruction cache, and where the instruction before was.
#[derive(Clone, Debug, Default)]
pub struct Cost {
    /// Lines held.
    lines: Vec<u32>,
    /// When each line of the flash was last used, 0 for one that is not held.
    used: Vec<u64>,
    uses: u64,
    last_line: u32,
    next_address: u32,
    /// Of the flash, as its register has them.
    pub wait_states: u64,
    /// Whether the cache is on.
    pub cached: bool,
    /// Cycles of 170 MHz in a cycle of the core.
    pub cycle: u64,
    /// Lines that the cache did not have.
    pub misses: u64,
}

impl Cost {
    /// Of the instruction at this address, of so many bytes [cycles of 170 MHz].
    #[inline]
    pub fn of(&mut self, address: u32, bytes: u32) -> u64 {
        let branch = if address == self.next_address { 0 } else { BRANCH_CYCLES };
        self.next_address = address + bytes;
        let line = address / LINE_BYTES;
        let is_there = line == self.last_line || address >= CCM_START;
        let fetch = if is_there { 0 } else { self.fetch(line) };
        (1 + branch + fetch) * self.cycle
    }

    /// What it takes to have another line.
    fn fetch(&mut self, line: u32) -> u64 {
        self.last_line = line;
        self.uses += 1;
        let index = index(line);
        if self.used.len() <= index {
            self.used.resize(index + 1, 0);
        }
        let is_held = std::mem::replace(&mut self.used[index], self.uses) > 0;
        if is_held && self.cached {
            return 0;
        }
        self.misses += 1;
        if !is_held {
            self.hold(line);
        }
        self.wait_states
    }

    /// Takes a line into the cache, in place of the one used longest ago.
    fn hold(&mut self, line: u32) {
        if self.lines.len() < LINES {
            return self.lines.push(line);
        }
        let used = &self.used;
        if let Some(oldest) = self.lines.iter_mut().min_by_key(|held| used[index(**held)]) {
            let left = std::mem::replace(oldest, line);
            self.used[index(left)] = 0;
        }
    }
}

/// The place of a line in the flash.
fn index(line: u32) -> usize {
    line as usize % (FLASH_BYTES / LINE_BYTES as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_loop_in_the_cache_pays_for_its_lines_once() {
        let mut cost = Cost { wait_states: 4, cached: true, cycle: 1, ..Cost::default() };
        let round = |cost: &mut Cost| (0..64).map(|k| cost.of(0x0800_0000 + 2 * k, 2)).sum::<u64>();
        assert_eq!(round(&mut cost), 64 + 2 + 4 * 4);
        assert_eq!(round(&mut cost), 64 + 2);
        assert_eq!(cost.misses, 4);
    }
}
