//! The time of a tick, from an integer count.

/// The middle of a tick's interval: a command acts from its tick to the next, so the reference
/// is evaluated in between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// Ticks since the reference began.
    pub tick: u32,
    /// Length of a tick [s].
    pub period_s: f32,
    /// Ticks a second.
    pub rate_per_s: f32,
}

impl Time {
    /// The middle of the interval after `tick`.
    #[inline]
    pub fn new(tick: u32, period_s: f32, rate_per_s: f32) -> Self {
        Self { tick, period_s, rate_per_s }
    }

    /// Seconds since the reference began; exact to a few microseconds over an hour.
    #[inline]
    pub fn seconds(&self) -> f32 {
        (self.tick as f32 + 0.5) * self.period_s
    }

    /// How many whole ticks a span of seconds is, at least one.
    #[inline]
    pub fn ticks_in(&self, span_s: f32) -> u32 {
        ((span_s * self.rate_per_s + 0.5) as u32).max(1)
    }

    /// How far a cycle has gone, in [0, 1): it repeats exactly, however often.
    #[inline]
    pub fn fraction_of_cycle(&self, cycle_s: f32) -> f32 {
        let ticks = self.ticks_in(cycle_s);
        ((self.tick % ticks) as f32 + 0.5) / ticks as f32
    }

    /// The time since `start_tick`, which must not lie ahead.
    #[inline]
    pub fn since(&self, start_tick: u32) -> Self {
        Self { tick: self.tick.saturating_sub(start_tick), ..*self }
    }
}
