//! Some minutes of the soak; `cargo xtask soak` runs a day of it.
#![allow(missing_docs)]

use tests::soak::{Settings, soak};

/// The fifth fault that a soak injects is a bit of the parameters in use.
#[test]
fn minutes_at_a_noisy_line_lose_nothing_that_was_acknowledged() {
    let settings = Settings { duration_s: 120, sessions: 25, bytes_per_error: 1000, seed: 1 };
    let counters = soak(&settings, |_| {});
    println!("{counters}");
    assert!(counters.ticks >= 120_000);
    assert!(counters.bytes_broken * 2000 > counters.bytes, "the line was noisy");
    assert_eq!((counters.uploads, counters.resets), (25, 2));
    assert!(counters.records_dropped > 0 && counters.records_missed >= counters.records_dropped);
    assert_eq!((counters.faults_injected, counters.faults_otherwise), (5, 0));
}
