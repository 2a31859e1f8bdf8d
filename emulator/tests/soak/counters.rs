//! What a soak has counted.

use std::fmt::{Display, Formatter, Result};

use super::ending::Ending;

#[derive(Clone, Debug, Default)]
pub struct Counters {
    /// Milliseconds of the board, and in which states its ticks were, by [`firmware::supervisor::State`].
    pub ms: u64,
    pub ticks_in: [u64; 6],
    /// Sessions by ending.
    pub endings: [u32; Ending::ALL.len()],
    pub uploads: u32,
    pub commits: u32,
    pub resets: usize,
    pub faults: u32,
    pub requests: u64,
    /// Records of telemetry that came, and those missed between two.
    pub records: u64,
    pub missed: u64,
    /// From what happens to 0 V at the latest, where the arm is not braked first [ms].
    pub worst_ms: [f64; Ending::ALL.len()],
    /// The tick's longest run [cycles], but for the check of each second.
    pub longest_tick_cycles: u64,
    pub stack_bytes: usize,
}

/// Each with each.
fn joined<T: Copy, const N: usize>(one: [T; N], other: [T; N], with: fn(T, T) -> T) -> [T; N] {
    std::array::from_fn(|i| with(one[i], other[i]))
}

impl Counters {
    /// Those of two boards together.
    pub fn and(&self, other: &Self) -> Self {
        Self {
            ms: self.ms + other.ms,
            ticks_in: joined(self.ticks_in, other.ticks_in, |a, b| a + b),
            endings: joined(self.endings, other.endings, |a, b| a + b),
            uploads: self.uploads + other.uploads,
            commits: self.commits + other.commits,
            resets: self.resets + other.resets,
            faults: self.faults + other.faults,
            requests: self.requests + other.requests,
            records: self.records + other.records,
            missed: self.missed + other.missed,
            worst_ms: joined(self.worst_ms, other.worst_ms, f64::max),
            longest_tick_cycles: self.longest_tick_cycles.max(other.longest_tick_cycles),
            stack_bytes: self.stack_bytes.max(other.stack_bytes),
        }
    }
}

impl Display for Counters {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let [boot, disarmed, armed, running, faulted, stopping] = self.ticks_in;
        let hours = self.ms as f64 / 3.6e6;
        writeln!(f, "{hours:.3} h, {} records, {} missed", self.records, self.missed)?;
        writeln!(
            f,
            "ticks told: {boot} boot, {disarmed} disarmed, {armed} armed, {running} running,"
        )?;
        writeln!(f, "  {stopping} stopping, {faulted} faulted")?;
        for ((ending, count), worst_ms) in Ending::ALL.iter().zip(self.endings).zip(self.worst_ms) {
            writeln!(f, "  {count:3} {ending:?}, 0 V within {worst_ms:.2} ms where at once")?;
        }
        writeln!(
            f,
            "{} uploads, {} of them committed, {} resets",
            self.uploads, self.commits, self.resets
        )?;
        writeln!(
            f,
            "{} faults, each the one injected; {} requests answered",
            self.faults, self.requests
        )?;
        writeln!(
            f,
            "longest tick {} cycles, stack {} bytes",
            self.longest_tick_cycles, self.stack_bytes
        )
    }
}
