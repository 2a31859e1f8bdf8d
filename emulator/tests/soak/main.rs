//! Sessions at emulated boards, one after the other: upload, home, arm, run, and an ending each.
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

use counters::Counters;
use ending::Ending;
use session::Soak;

/// Hours of the board that are asked for.
fn hours() -> f64 {
    std::env::var("RRR_SOAK_HOURS").ok().and_then(|hours| hours.parse().ok()).unwrap_or(0.0)
}

/// So many sessions or hours, whichever is more, at a board of its own.
fn sessions(seed: u64, endings: &[Ending], hours: f64) -> Counters {
    let image = common::image().expect("it was there");
    let mut soak = Soak::new(&image, seed, hours > 0.0);
    let mut session = 0;
    while session < endings.len() || soak.hours() < hours {
        soak.session(session, endings[session % endings.len()]);
        session += 1;
        if session.is_multiple_of(endings.len()) {
            println!("board {seed}, after {session} sessions:\n{}", soak.counters);
        }
    }
    soak.counters
}

#[test]
fn sessions_that_end_in_every_way_leave_the_board_as_it_was() {
    if common::image().is_none() {
        return;
    }
    if hours() == 0.0 {
        sessions(1, &Ending::ONLY_HERE, 0.0);
        return;
    }
    // Two boards side by side, each with half of the hours.
    let boards =
        [1, 2].map(|seed| std::thread::spawn(move || sessions(seed, &Ending::ALL, hours() / 2.0)));
    let [first, second] =
        boards.map(|board| board.join().expect("what does not hold is said above"));
    println!("both boards:\n{}", first.and(&second));
}
