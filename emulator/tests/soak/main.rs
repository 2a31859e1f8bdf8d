//! Sessions at the emulated board, one after the other: upload, home, arm, run, and an ending each.
//!
//! `RRR_SOAK_HOURS` says for how long; without it those endings come that no other test has, once
//! each, after short runs.
#![allow(missing_docs)]

#[path = "../common.rs"]
mod common;
mod counters;
mod draw;
mod ending;
mod injected;
mod rig_bench;
mod session;

use ending::Ending;
use session::Soak;

/// Hours of the board that are asked for.
fn hours() -> f64 {
    std::env::var("RRR_SOAK_HOURS").ok().and_then(|hours| hours.parse().ok()).unwrap_or(0.0)
}

#[test]
fn sessions_that_end_in_every_way_leave_the_board_as_it_was() {
    let Some(image) = common::image() else { return };
    let is_long = hours() > 0.0;
    let endings = if is_long { &Ending::ALL[..] } else { &Ending::ONLY_HERE[..] };
    let mut soak = Soak::new(&image, is_long);
    let mut session = 0;
    while session < endings.len() || soak.hours() < hours() {
        soak.session(session, endings[session % endings.len()]);
        session += 1;
        if session.is_multiple_of(endings.len()) {
            println!("after {session} sessions:\n{}", soak.counters);
        }
    }
}
