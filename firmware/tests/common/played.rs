//! Ticks played to a supervisor, up to the fault that they cause.

use firmware::DacCode;
use firmware::supervisor::{FaultRecord, Health, State, Supervisor};

/// Codes of no voltage.
pub const ZERO: [DacCode; 3] = [DacCode(0); 3];
/// Counts of an encoder at 1 rad.
pub const COUNTS_PER_RAD: f64 = 655_360.0 / std::f64::consts::TAU;

/// What a fault is found in: the tick (from 1) of those played, and the record.
pub struct Found {
    /// Number of the tick.
    pub tick: u32,
    /// What is recorded.
    pub record: FaultRecord,
}

/// Plays ticks until a fault; asserts zero in that tick and after it, and not before.
pub fn play(
    supervisor: &mut Supervisor,
    ticks: impl IntoIterator<Item = ([i32; 3], Health)>,
) -> Option<Found> {
    let mut found: Option<Found> = None;
    for (number, (counts, health)) in (1..).zip(ticks) {
        let output = supervisor.tick(&counts, health);
        match (&found, supervisor.fault()) {
            (None, Some(record)) => {
                assert_eq!((output.codes, output.state), (ZERO, State::Faulted), "at once");
                assert_eq!(output.fault, Some((record.fault, record.joint)));
                assert_eq!(record.tick, output.tick);
                found = Some(Found { tick: number, record });
            }
            (Some(first), now) => {
                assert_eq!(output.codes, ZERO);
                assert_eq!(now, Some(first.record), "the first cause stays");
            }
            (None, None) => assert_eq!(output.fault, None),
        }
    }
    let found = found?;
    println!(
        "{:22} zero in tick {}, in which it was found: {}",
        found.record.fault.name(),
        found.tick,
        found.record
    );
    Some(found)
}

/// So many ticks at these counts, all well.
pub fn quiet(counts: impl Fn(i32) -> [i32; 3], ticks: i32) -> Vec<([i32; 3], Health)> {
    (1..=ticks).map(|k| (counts(k), Health::default())).collect()
}
