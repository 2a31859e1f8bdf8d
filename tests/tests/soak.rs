//! Some minutes of the soak; `cargo xtask soak` runs a day of it.
#![allow(missing_docs)]

use tests::soak::{Settings, soak};

/// Each of the eight faults that a soak injects, once.
#[test]
fn minutes_at_a_noisy_line_lose_nothing_that_was_acknowledged() {
    let settings = Settings { duration_s: 200, sessions: 40, bytes_per_error: 1000, seed: 1 };
    let counters = soak(&settings, |_| {});
    println!("{counters}");
    assert!(counters.ticks >= 200_000);
    assert!(counters.bytes_broken * 2000 > counters.bytes, "the line was noisy");
    assert_eq!((counters.uploads, counters.resets), (40, 4));
    assert!(counters.records_dropped > 0 && counters.records_missed >= counters.records_dropped);
    assert_eq!((counters.faults_injected, counters.faults_otherwise), (8, 0));
}
