//! Some minutes of the soak; `cargo xtask soak` runs a day of it.
#![allow(missing_docs)]

use tests::soak::{Settings, soak};

/// The fifth fault that a soak injects is a bit of the parameters in use.
#[test]
fn minutes_at_a_noisy_line_lose_nothing_that_was_acknowledged() {
    let settings = Settings { duration_s: 120, sessions: 25, bytes_per_error: 1000, seed: 1 };
    let tally = soak(&settings, |_| {});
    println!("{tally}");
    assert!(tally.ticks >= 120_000);
    assert!(tally.bytes_broken * 2000 > tally.bytes, "the line was noisy");
    assert_eq!((tally.uploads, tally.resets), (25, 2));
    assert!(tally.records_dropped > 0 && tally.records_missed >= tally.records_dropped);
    assert_eq!((tally.faults_injected, tally.faults_otherwise), (5, 0));
}
