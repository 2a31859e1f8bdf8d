//! A minute of the soak; `cargo xtask soak` runs a day of it.
#![allow(missing_docs)]

use tests::soak::{Settings, soak};

#[test]
fn a_minute_at_a_noisy_line_loses_nothing_that_was_acknowledged() {
    let settings = Settings { duration_s: 60, sessions: 10, bytes_per_error: 1000, seed: 1 };
    let tally = soak(&settings, |_| {});
    println!("{tally}");
    assert!(tally.ticks >= 60_000);
    assert!(tally.bytes_broken * 2000 > tally.bytes, "the line was noisy");
    assert_eq!((tally.uploads, tally.resets), (10, 1));
    assert_eq!((tally.faults_injected, tally.faults_otherwise), (2, 0));
}
