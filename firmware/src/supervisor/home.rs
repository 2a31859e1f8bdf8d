//! Where the arm is: encoders that count from zero at power-on, and the word of who saw it.

use super::fault::Implausible;
use crate::Angle;

/// An encoder that went less far since power-on, or since it failed, may be dead [counts].
const ALIVE_COUNTS: u32 = 64;

/// What must be added to each encoder's count for the model's zero to be zero.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Home {
    offset_counts: [i32; 3],
    /// The encoders have counted from zero since power-on, wherever the arm was.
    begins_lost: bool,
    told: [bool; 3],
    /// Since power-on.
    last_counts: [i32; 3],
    /// From where on an encoder is looked at for whether it counts at all.
    base_counts: [i32; 3],
    furthest_counts: [u32; 3],
}

impl Home {
    /// At power-on; `begins_lost` if the encoders do not know where they are.
    pub fn at_boot(begins_lost: bool) -> Self {
        Self { begins_lost, ..Self::default() }
    }

    /// Counts from the model's zero on.
    #[inline]
    pub fn of_model(&mut self, since_power_on: &[i32; 3]) -> [i32; 3] {
        self.last_counts = *since_power_on;
        let mut counts = *since_power_on;
        for i in 0..3 {
            let went = counts[i].wrapping_sub(self.base_counts[i]).unsigned_abs();
            self.furthest_counts[i] = self.furthest_counts[i].max(went);
            counts[i] = counts[i].wrapping_add(self.offset_counts[i]);
        }
        counts
    }

    /// Takes the word that the joints are at `position` now; that of a joint whose encoder may
    /// be dead does not count.
    pub fn tell(&mut self, position: &[Angle; 3], counts_per_turn: u32) {
        for i in 0..3 {
            let wanted = position[i].in_counts(counts_per_turn);
            self.offset_counts[i] = wanted.wrapping_sub(self.last_counts[i]);
            self.told[i] = !self.seems_dead(i);
        }
    }

    /// The encoder of joint `index` (0 to 2) has failed: what was told of it is void.
    #[cold]
    pub fn doubt(&mut self, index: usize) {
        self.told[index] = false;
        self.base_counts[index] = self.last_counts[index];
        self.furthest_counts[index] = 0;
    }

    /// The counts have another meaning from now on: what was told is void.
    pub fn forget(&mut self) {
        (self.offset_counts, self.told) = ([0; 3], [false; 3]);
    }

    /// Whether the counts of each joint are those of the model.
    pub fn is_known(&self) -> [bool; 3] {
        self.told.map(|told| told || !self.begins_lost)
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
        self.begins_lost && self.furthest_counts[index] < ALIVE_COUNTS
    }
}
