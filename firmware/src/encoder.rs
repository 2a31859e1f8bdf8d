//! From encoder counts to [`Angle`]s.

use core::num::NonZeroU32;

use crate::Angle;

/// How many counts make a turn, as a fixed-point factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EncoderScale {
    /// Never zero, so that dividing by it cannot panic in the tick.
    counts_per_turn: NonZeroU32,
    /// Angle units per count, times 2^31 once the count is shifted left.
    factor: u32,
    shift_left: u32,
}

/// The fewest and the most counts a turn that [`EncoderScale`] takes.
pub const COUNTS_PER_TURN: core::ops::RangeInclusive<u32> = 64..=(1 << 24);

impl EncoderScale {
    /// The scale of an encoder, with `counts_per_turn` inside [`COUNTS_PER_TURN`].
    pub fn new(counts_per_turn: u32) -> Self {
        let fewest = NonZeroU32::MIN.saturating_add(COUNTS_PER_TURN.start() - 1);
        let counts_per_turn = NonZeroU32::new(counts_per_turn.min(*COUNTS_PER_TURN.end()))
            .map_or(fewest, |counts| counts.max(fewest));
        // The largest factor that fits 32 bits: a whole turn is wrong by less than
        // two units of Angle.
        let shift = counts_per_turn.ilog2();
        let turn = 1_u64 << (32 + shift);
        let factor = ((turn - 1) / u64::from(counts_per_turn.get())) as u32;
        // A count within the turn has one bit more, so that it fits 32 bits when it is shifted.
        Self { counts_per_turn, factor, shift_left: 31 - shift }
    }

    /// The angle of a count within the turn.
    #[inline]
    fn angle(&self, count_in_turn: u32) -> Angle {
        let shifted = count_in_turn << (self.shift_left & 31);
        Angle(((u64::from(shifted) * u64::from(self.factor)) >> 31) as u32 as i32)
    }
}

/// A count within the turn, from 0 up.
#[inline]
fn remainder(count: i32, turn: NonZeroU32) -> u32 {
    let rest = count.unsigned_abs() % turn;
    if count < 0 && rest != 0 { turn.get() - rest } else { rest }
}

/// One encoder: reduces its endless count to the turn, in integers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Encoder {
    scale: EncoderScale,
    last_count: i32,
    count_in_turn: u32,
}

impl Encoder {
    /// An encoder whose count is zero at angle zero.
    pub fn new(scale: EncoderScale) -> Self {
        Self { scale, last_count: 0, count_in_turn: 0 }
    }

    /// Its scale.
    pub fn scale(&self) -> EncoderScale {
        self.scale
    }

    /// The angle at a count since power-on, which may wrap at 32 bits.
    ///
    /// Only differences of counts are used, so a wrap (after an hour at full
    /// speed) passes unseen.
    #[inline]
    pub fn update(&mut self, count: i32) -> Angle {
        let moved = count.wrapping_sub(self.last_count);
        // Below zero it wraps to more than any turn has.
        let sum = self.count_in_turn.wrapping_add_signed(moved);
        let is_in_turn = sum < self.scale.counts_per_turn.get();
        self.count_in_turn = if is_in_turn { sum } else { self.beyond_the_turn(moved) };
        self.last_count = count;
        self.scale.angle(self.count_in_turn)
    }

    /// The count within the turn after a move that leaves it.
    #[cold]
    fn beyond_the_turn(&self, moved: i32) -> u32 {
        let turn = self.scale.counts_per_turn;
        let sum = self.count_in_turn + remainder(moved, turn);
        if sum >= turn.get() { sum - turn.get() } else { sum }
    }
}

/// Extends a hardware counter of 16 bits to the 32 that [`Encoder`] takes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CounterExtender {
    count: i32,
}

impl CounterExtender {
    /// The count since power-on; the joint must move less than 32,767 counts between calls.
    #[inline]
    pub fn update(&mut self, hardware_count: u16) -> i32 {
        let moved = hardware_count.wrapping_sub(self.count as u16) as i16;
        self.count = self.count.wrapping_add(i32::from(moved));
        self.count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNTS: u32 = 655_360;

    fn angle_after(path: impl IntoIterator<Item = i32>) -> Angle {
        let mut encoder = Encoder::new(EncoderScale::new(COUNTS));
        path.into_iter().map(|count| encoder.update(count)).last().unwrap()
    }

    #[test]
    fn a_quarter_turn_is_a_quarter_turn() {
        let quarter = angle_after([COUNTS as i32 / 4]);
        assert!((quarter.0 - (1 << 30)).abs() <= 1, "{quarter:?}");
        assert!((angle_after([-(COUNTS as i32) / 4]).0 + (1 << 30)).abs() <= 1);
    }

    #[test]
    fn an_hour_at_full_speed_loses_no_count() {
        let step = 983_i32; // 9.4 rad/s
        let ticks = 3_600_000_u32;
        let path = (1..=ticks).map(|k| (k as i32).wrapping_mul(step));
        let in_turn = (u64::from(ticks) * 983 % u64::from(COUNTS)) as f64;
        let expected = (in_turn / f64::from(COUNTS) * 4_294_967_296.0) as u32 as i32;
        let error = angle_after(path).0.wrapping_sub(expected);
        assert!(error.abs() <= 1, "{error}");
    }

    #[test]
    fn sixteen_bits_are_extended_over_wraps() {
        let mut extender = CounterExtender::default();
        let counts = (0..100_000_i32).map(|k| k * -300).map(|c| (c, extender.update(c as u16)));
        assert!(counts.into_iter().all(|(true_count, extended)| true_count == extended));
    }
}
