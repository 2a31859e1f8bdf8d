//! What the ticks count.

/// Counts since power-on, wrapping.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TickCounters {
    /// Ticks.
    pub ticks: u32,
    /// Ticks that were not done when the next one was due.
    pub overruns: u32,
    /// Longest tick [0.1 us].
    pub longest_tick_tenth_us: u32,
    /// Ticks in which a joint's command was cut at its limit. A limit, not a fault.
    pub saturated: [u32; 3],
}
