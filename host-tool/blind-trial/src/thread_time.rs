//! Processor time of a thread.

use std::time::Duration;

use nix::time::{ClockId, clock_gettime};

/// What this thread has computed for so far.
pub fn thread_time() -> Duration {
    clock_gettime(ClockId::CLOCK_THREAD_CPUTIME_ID).map_or(Duration::ZERO, Duration::from)
}
