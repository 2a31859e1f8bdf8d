//! What a log does not hold itself, but its recording as MCAP tells.

use std::time::{SystemTime, UNIX_EPOCH};

use super::BoardSample;

/// What is known beside a log.
#[derive(Clone, Copy, Debug, Default)]
pub struct McapDetails<'a> {
    /// Encoder counts per turn, with which counts become angles.
    pub counts_per_rev: Option<f64>,
    /// When `t_s` was 0, in nanoseconds since 1970; messages then have the time of the wall's clock.
    pub began_unix_ns: u64,
    /// What the board reported beside its joints.
    pub board: &'a [BoardSample],
}

/// Nanoseconds since 1970: the second that SOURCE_DATE_EPOCH names, where it names one, so that what
/// is written twice is the same twice; else now.
pub fn unix_ns() -> u64 {
    let named = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|text| text.parse::<u64>().ok());
    let now = || SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_nanos());
    match named {
        Some(second) => second.saturating_mul(1_000_000_000),
        None => u64::try_from(now()).unwrap_or(u64::MAX),
    }
}
