//! The parameters in use against their checksums, a part at a time, so that no tick takes long.

use super::state_machine::Supervisor;
use crate::block::PARTS;

/// Parts of what is checked: those of the block, what was derived from it, the limits of each joint.
pub(super) const WATCHED_PARTS: usize = PARTS + 4;
/// Ticks from one part to the next.
const PART_EVERY_TICKS: u32 = 62;
/// An odd tick, so that it is never one in which a board looks at its converter.
const PHASE_TICKS: u32 = 31;
/// By then every part has been checked once more.
pub const CHECK_EVERY_TICKS: u32 = 1000;

const _: () = assert!(WATCHED_PARTS as u32 * PART_EVERY_TICKS <= CHECK_EVERY_TICKS);

/// Which parts were found changed.
#[derive(Clone, Copy, Debug, Default)]
pub struct ParameterWatch {
    next: usize,
    changed: u32,
}

impl ParameterWatch {
    /// Whether a part is to be checked in this tick, after its codes are out.
    #[inline]
    pub fn is_due(tick: u32) -> bool {
        tick % PART_EVERY_TICKS == PHASE_TICKS
    }

    /// Checks the next part; whether any part is known to have changed, for
    /// [`Health::parameters_corrupt`](super::Health::parameters_corrupt).
    pub fn check(&mut self, supervisor: &Supervisor) -> bool {
        let bit = 1 << self.next;
        match supervisor.part_is_intact(self.next) {
            true => self.changed &= !bit,
            false => self.changed |= bit,
        }
        self.next = if self.next + 1 < WATCHED_PARTS { self.next + 1 } else { 0 };
        self.changed != 0
    }
}
