//! The interrupt controller: what is pending, what is active, and which of them comes next.

use crate::failure::Refusal;
use crate::registers::{Access, Level};

/// Lines of the STM32G474.
const LINES: usize = 102;
/// Exceptions of the core come before the lines.
pub const FIRST_LINE: usize = 16;
/// Numbers of exceptions.
pub const NMI: usize = 2;
/// After a fault of the core.
pub const HARD_FAULT: usize = 3;
/// By software.
pub const PEND_SV: usize = 14;
/// All of them.
const EXCEPTIONS: usize = FIRST_LINE + LINES;
/// Lower than all that can be set.
const THREAD: i32 = 256;

/// Exceptions by their numbers; line n is exception 16 + n.
#[derive(Clone, Debug)]
pub struct Nvic {
    enabled: [bool; EXCEPTIONS],
    pending: [bool; EXCEPTIONS],
    level: [bool; EXCEPTIONS],
    /// Of the lines and of the core's exceptions that have one.
    priority: [u8; EXCEPTIONS],
    /// Innermost last.
    active: Vec<usize>,
    /// Bits of the priority that make no interruption, from AIRCR.
    pub group: u8,
    any_pending: bool,
}

impl Default for Nvic {
    fn default() -> Self {
        let mut enabled = [false; EXCEPTIONS];
        enabled[..FIRST_LINE].fill(true);
        Self {
            enabled,
            pending: [false; EXCEPTIONS],
            level: [false; EXCEPTIONS],
            priority: [0; EXCEPTIONS],
            active: Vec::new(),
            group: 0,
            any_pending: false,
        }
    }
}

impl Nvic {
    /// Makes an exception pending.
    pub fn pend(&mut self, exception: usize) {
        self.pending[exception] = true;
        self.any_pending = true;
    }

    /// Takes what a block has on its line; a rising one makes it pending.
    pub fn set_level(&mut self, line: usize, level: Level) {
        let exception = FIRST_LINE + line;
        if level && !self.level[exception] && !self.active.contains(&exception) {
            self.pend(exception);
        }
        self.level[exception] = level;
    }

    /// The exception that comes next, were nothing masked, and whether PRIMASK holds it off.
    pub fn next(&self) -> Option<(usize, bool)> {
        if !self.any_pending {
            return None;
        }
        let ready = (0..EXCEPTIONS).filter(|n| self.pending[*n] && self.enabled[*n]);
        let next = ready.min_by_key(|n| (self.priority_of(*n), *n))?;
        let running = self.active.iter().map(|n| self.group_of(*n)).min().unwrap_or(THREAD);
        let comes = self.group_of(next) < running;
        comes.then_some((next, self.priority_of(next) >= 0))
    }

    /// Begins an exception.
    pub fn enter(&mut self, exception: usize) {
        self.pending[exception] = false;
        self.any_pending = self.pending.contains(&true);
        self.active.push(exception);
    }

    /// Ends the innermost one; `None` if there is none. A line that is still up comes again.
    pub fn leave(&mut self) -> Option<usize> {
        let exception = self.active.pop()?;
        if self.level[exception] {
            self.pend(exception);
        }
        Some(exception)
    }

    /// The innermost exception, 0 for the thread.
    pub fn running(&self) -> usize {
        self.active.last().copied().unwrap_or(0)
    }

    /// How many are active.
    pub fn depth(&self) -> usize {
        self.active.len()
    }

    fn priority_of(&self, exception: usize) -> i32 {
        match exception {
            NMI => -2,
            HARD_FAULT => -1,
            _ => i32::from(self.priority[exception]),
        }
    }

    fn group_of(&self, exception: usize) -> i32 {
        let priority = self.priority_of(exception);
        if priority < 0 { priority } else { priority & !((2 << self.group) - 1) }
    }

    /// A register from 0xE000E100 on.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn read(&self, offset: u32) -> Access<u32> {
        let word = (offset % 0x80) as usize / 4;
        match offset {
            0x000..0x010 | 0x080..0x090 => Ok(bits(&self.enabled, word)),
            0x100..0x110 | 0x180..0x190 => Ok(bits(&self.pending, word)),
            0x300..0x368 => {
                let first = FIRST_LINE + (offset - 0x300) as usize;
                Ok(u32::from_le_bytes(
                    [0, 1, 2, 3].map(|i| self.priority.get(first + i).copied().unwrap_or(0)),
                ))
            }
            _ => Err(Refusal::NotModelled),
        }
    }

    /// The same, written; priorities by bytes.
    ///
    /// # Errors
    /// None of those modelled.
    pub fn write(&mut self, offset: u32, bytes: usize, value: u32) -> Access<()> {
        let word = (offset % 0x80) as usize / 4;
        match offset {
            0x000..0x010 => set(&mut self.enabled, word, value, true),
            0x080..0x090 => set(&mut self.enabled, word, value, false),
            0x100..0x110 => set(&mut self.pending, word, value, true),
            0x180..0x190 => set(&mut self.pending, word, value, false),
            0x300..0x368 => {
                for (index, byte) in value.to_le_bytes().into_iter().take(bytes).enumerate() {
                    let exception = FIRST_LINE + (offset - 0x300) as usize + index;
                    if let Some(priority) = self.priority.get_mut(exception) {
                        // Four bits are there.
                        *priority = byte & 0xF0;
                    }
                }
            }
            _ => return Err(Refusal::NotModelled),
        }
        self.any_pending = self.pending.contains(&true);
        Ok(())
    }

    /// Sets the priority of an exception of the core.
    pub fn set_core_priority(&mut self, exception: usize, priority: u8) {
        self.priority[exception] = priority & 0xF0;
    }

    /// Takes back what is pending.
    pub fn unpend(&mut self, exception: usize) {
        self.pending[exception] = false;
    }
}

fn bits(of: &[bool; EXCEPTIONS], word: usize) -> u32 {
    let line = |bit: usize| of.get(FIRST_LINE + 32 * word + bit).copied().unwrap_or(false);
    (0..32).fold(0, |bits, bit| bits | u32::from(line(bit)) << bit)
}

fn set(of: &mut [bool; EXCEPTIONS], word: usize, value: u32, to: bool) {
    for bit in (0..32).filter(|bit| value >> bit & 1 == 1) {
        if let Some(line) = of.get_mut(FIRST_LINE + 32 * word + bit) {
            *line = to;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_priorities(priorities: [(usize, u8); 2]) -> Nvic {
        let mut nvic = Nvic::default();
        for (line, priority) in priorities {
            nvic.write(0x300 + line as u32, 1, u32::from(priority)).unwrap();
            nvic.write(4 * (line as u32 / 32), 4, 1 << (line % 32)).unwrap();
        }
        nvic
    }

    #[test]
    fn the_more_urgent_interrupts_the_other_and_not_the_reverse() {
        let mut nvic = with_priorities([(5, 0x60), (40, 0x00)]);
        nvic.set_level(5, true);
        assert_eq!(nvic.next(), Some((21, true)));
        nvic.enter(21);
        assert_eq!(nvic.next(), None);
        nvic.set_level(40, true);
        assert_eq!(nvic.next(), Some((56, true)));
        nvic.enter(56);
        nvic.set_level(40, false);
        assert_eq!((nvic.leave(), nvic.next()), (Some(56), None));
        assert_eq!((nvic.leave(), nvic.next()), (Some(21), Some((21, true))), "still up");
    }

    #[test]
    fn equals_do_not_interrupt_each_other_and_nothing_masks_the_nmi() {
        let mut nvic = with_priorities([(5, 0x60), (6, 0x60)]);
        nvic.set_level(6, true);
        nvic.enter(22);
        nvic.set_level(5, true);
        assert_eq!(nvic.next(), None);
        nvic.pend(NMI);
        assert_eq!(nvic.next(), Some((NMI, false)));
    }
}
