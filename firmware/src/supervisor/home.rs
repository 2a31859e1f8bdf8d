//! Where the arm is: encoders that count from zero at power-on, and the word of who saw it.

use super::fault::Implausible;
use crate::Angle;

/// An encoder that went less far since power-on may be dead [counts].
const ALIVE_COUNTS: u32 = 64;

/// What must be added to each encoder's count for the model's zero to be zero.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Home {
    offset_counts: [i32; 3],
    /// The encoders have counted from zero since power-on, wherever the arm was.
    begins_lost: bool,
    told: bool,
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
        let mut counts = *since_power_on;
        for i in 0..3 {
            self.furthest_counts[i] = self.furthest_counts[i].max(counts[i].unsigned_abs());
            counts[i] = counts[i].wrapping_add(self.offset_counts[i]);
        }
        counts
    }

    /// Takes the word that the joints are at `position` now, where they count `now`.
    pub fn tell(&mut self, position: &[Angle; 3], now: &[i32; 3], counts_per_turn: u32) {
        for i in 0..3 {
            let wanted = position[i].in_counts(counts_per_turn);
            let change = wanted.wrapping_sub(now[i]);
            self.offset_counts[i] = self.offset_counts[i].wrapping_add(change);
        }
        self.told = true;
    }

    /// The counts have another meaning from now on: what was told is void.
    pub fn forget(&mut self) {
        (self.offset_counts, self.told) = ([0; 3], false);
    }

    /// Whether the counts are those of the model.
    pub fn is_known(&self) -> bool {
        self.told || !self.begins_lost
    }

    /// Why the position of joint `index` (0 to 2) must not be trusted, if so; `follows`: it will
    /// be fed back.
    pub fn implausible(&self, index: usize, follows: bool) -> Option<Implausible> {
        if !self.is_known() {
            return Some(Implausible::NoHome);
        }
        let seems_dead = self.begins_lost && self.furthest_counts[index] < ALIVE_COUNTS;
        (follows && seems_dead).then_some(Implausible::NeverMoved)
    }
}
