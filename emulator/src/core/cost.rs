//! How long instructions take: one cycle each, and what the flash and the pipeline add.
//!
//! The flash delivers 256 bits in 1 + wait states cycles; the instruction cache of 1 KiB holds 32
//! such lines, the one used longest ago makes room (RM0440, 3.3.4). A taken branch refills the
//! pipeline. Left out: wait states of data in the flash, divisions and multiple loads, contention
//! of the buses. So cycles are too few by an estimated 10 to 40 percent.

/// Bytes of a line of the cache.
const LINE_BYTES: u32 = 32;
/// Lines of the cache.
const LINES: usize = 32;
/// Cycles that a taken branch adds; the core takes one to three.
const BRANCH_CYCLES: u64 = 2;

/// The instruction cache, and where the instruction before was.
#[derive(Clone, Debug, Default)]
pub struct Cost {
    /// Lines held, the one used last at the end.
    lines: Vec<u32>,
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
        let fetch = if line == self.last_line { 0 } else { self.fetch(line) };
        (1 + branch + fetch) * self.cycle
    }

    /// What it takes to have another line.
    fn fetch(&mut self, line: u32) -> u64 {
        self.last_line = line;
        match self.lines.iter().rposition(|held| *held == line) {
            Some(index) if self.cached => {
                let held = self.lines.remove(index);
                self.lines.push(held);
                return 0;
            }
            _ => {}
        }
        self.misses += 1;
        if self.lines.len() == LINES {
            self.lines.remove(0);
        }
        self.lines.push(line);
        self.wait_states
    }
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
