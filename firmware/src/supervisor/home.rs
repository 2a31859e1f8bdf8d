//! Homing: encoders count from zero at power-on, wherever the arm is, until its position is set.

use super::fault::Implausible;
use crate::Angle;

/// An encoder that has moved less than this since power-on, or since it failed, may be dead [counts].
const ALIVE_COUNTS: u32 = 64;

/// What must be added to each encoder's count for the model's zero to be zero.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Home {
    offset_counts: [i32; 3],
    /// The encoders have counted from zero since power-on, wherever the arm was.
    lost_at_power_on: bool,
    is_set: [bool; 3],
    /// Since power-on.
    last_counts: [i32; 3],
    /// Where each encoder was at power-on, or when it failed last.
    base_counts: [i32; 3],
    furthest_counts: [u32; 3],
}

impl Home {
    /// At power-on; `lost_at_power_on` if the encoders do not know where they are.
    pub fn at_boot(lost_at_power_on: bool) -> Self {
        Self { lost_at_power_on, ..Self::default() }
    }

    /// Counts from the model's zero on.
    #[inline]
    pub fn model_counts(&mut self, since_power_on: &[i32; 3]) -> [i32; 3] {
        self.last_counts = *since_power_on;
        self.counts()
    }

    /// The same, of the last tick.
    #[inline]
    pub fn counts(&self) -> [i32; 3] {
        [0, 1, 2].map(|i| self.last_counts[i].wrapping_add(self.offset_counts[i]))
    }

    /// Notes how far the encoders have been moved, once a tick.
    #[inline]
    pub fn note_travel(&mut self) {
        for i in 0..3 {
            let went = self.last_counts[i].wrapping_sub(self.base_counts[i]).unsigned_abs();
            self.furthest_counts[i] = self.furthest_counts[i].max(went);
        }
    }

    /// Sets the present position of the joints; that of a joint whose encoder may be dead stays
    /// unknown.
    pub fn set(&mut self, position: &[Angle; 3], counts_per_turn: u32) {
        for i in 0..3 {
            let wanted = position[i].in_counts(counts_per_turn);
            self.offset_counts[i] = wanted.wrapping_sub(self.last_counts[i]);
            self.is_set[i] = !self.seems_dead(i);
        }
    }

    /// The encoder of joint `index` (0 to 2) has failed: its position is unknown.
    #[cold]
    pub fn invalidate(&mut self, index: usize) {
        self.is_set[index] = false;
        self.base_counts[index] = self.last_counts[index];
        self.furthest_counts[index] = 0;
    }

    /// The counts have another scale from now on: all positions are unknown.
    pub fn invalidate_all(&mut self) {
        (self.offset_counts, self.is_set) = ([0; 3], [false; 3]);
    }

    /// Whether the counts of each joint are those of the model.
    pub fn is_known(&self) -> [bool; 3] {
        self.is_set.map(|is_set| is_set || !self.lost_at_power_on)
    }

    /// Why the position of joint `index` (0 to 2), which is fed back, must not be trusted.
    pub fn implausible(&self, index: usize) -> Option<Implausible> {
        if self.seems_dead(index) {
            Some(Implausible::NeverMoved)
        } else if !self.is_known()[index] {
            Some(Implausible::NoHome)
        } else {
            None
        }
    }

    fn seems_dead(&self, index: usize) -> bool {
        self.lost_at_power_on && self.furthest_counts[index] < ALIVE_COUNTS
    }
}
