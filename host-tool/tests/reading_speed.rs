//! How fast the logs of a campaign are read.

use std::time::Instant;

use files::{Dataset, Log};

mod common;

/// 600,000 rows of three joints are to be read in well under a second on one core.
/// Unoptimised builds and busy machines are slower, so only the order is held.
#[test]
fn ten_minutes_of_three_joints_are_read_in_a_moment() {
    let directory = common::directory();
    let path = directory.path().join("long.csv.gz");
    let log = common::log_in_counts(600_000);
    log.write(&path).unwrap();
    let start = Instant::now();
    let read = Log::read(&path).unwrap();
    let seconds = start.elapsed().as_secs_f64();
    eprintln!("600,000 rows in {seconds:.3} s");
    assert_eq!(read.len(), log.len());
    assert!(seconds < 5.0, "{seconds} s");
}

#[test]
fn a_measured_campaign_is_read_in_a_moment() {
    let Some(path) = test_support::data("rig-1") else { return };
    let start = Instant::now();
    let recordings = Dataset::read(path).unwrap().recordings().unwrap();
    let rows: usize = recordings.iter().map(|recording| recording.log.len()).sum();
    eprintln!("{rows} rows in {:.3} s", start.elapsed().as_secs_f64());
    assert!(recordings.iter().all(|recording| recording.position_rad(3).is_some()));
}

#[test]
fn two_minutes_of_mcap_are_read_in_a_moment() {
    let directory = common::directory();
    let path = directory.path().join("long.mcap");
    common::log_in_counts(120_000).write(&path).unwrap();
    let start = Instant::now();
    let read = Log::read(&path).unwrap();
    let seconds = start.elapsed().as_secs_f64();
    eprintln!("120,000 rows of MCAP in {seconds:.3} s");
    assert_eq!(read.len(), 120_000);
    assert!(seconds < 5.0, "{seconds} s");
}
