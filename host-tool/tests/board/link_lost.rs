//! A link that is lost in the midst of a run.

use std::path::Path;
use std::sync::mpsc;
use std::time::{Duration, SystemTime};

use files::Dataset;
use simulation::simulated_board::SimulatedBoard;

use crate::line::{Deed, Line, at_query};
use crate::recording::assert_all_ticks_are_accounted_for;
use crate::{assert_tells, board, refused, rrr, rrr_at, with_model};

const LINE: &str = "run hold --duration 600 --out logs";

/// What a run tells on stderr whose link does this at the 5th sign of life; its log is kept.
fn printed(
    at: &Path,
    board: &SimulatedBoard,
    deed: impl FnMut() -> Deed + Send + 'static,
) -> String {
    let line = Line::to(board, at_query(1, 5, deed));
    let assert = rrr_at(at, &line.port, LINE);
    let figures = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
    let log = Dataset::read(at.join("logs")).unwrap().recordings().unwrap().remove(0).log;
    assert!(log.len() > 500, "{}", log.len());
    assert_all_ticks_are_accounted_for(&figures, &log);
    refused(assert)
}

#[test]
fn a_board_that_is_switched_off_breaks_the_link_and_the_log_is_kept() {
    let (directory, first) = (with_model(), board());
    let at = directory.path();
    rrr(at, &first, "upload model.toml").success();
    let (sender, is_time) = mpsc::channel();
    std::thread::scope(|scope| {
        let port = Line::to(
            &first,
            at_query(1, 5, move || {
                sender.send(()).unwrap();
                Deed::Pass
            }),
        )
        .port;
        let run = scope.spawn(move || refused(rrr_at(at, &port, LINE)));
        is_time.recv_timeout(Duration::from_secs(60)).unwrap();
        first.switch_off();
        assert_tells(&run.join().unwrap(), &["the link was lost in tick ", "look at the cable"]);
    });
    let dataset = Dataset::read(at.join("logs")).unwrap();
    assert!(dataset.recordings().unwrap()[0].log.len() > 500);
}

#[test]
fn a_board_that_falls_silent_costs_two_seconds_and_the_log_is_on_disk() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let (sender, silent) = mpsc::channel();
    let text = printed(at, &board, move || {
        sender.send(SystemTime::now()).unwrap();
        Deed::Silence
    });
    assert_tells(&text, &["the link was lost in tick ", "no answer to query", "look at the cable"]);
    let written = std::fs::metadata(at.join("logs/hold.csv.gz")).unwrap().modified().unwrap();
    let waited_s = written.duration_since(silent.recv().unwrap()).unwrap().as_secs_f64();
    assert!((1.2..2.2).contains(&waited_s), "{waited_s} s");
}

#[test]
fn a_board_that_is_reset_is_told_as_such_and_the_log_is_kept() {
    let (directory, first, second) = (with_model(), board(), board());
    let at = directory.path();
    rrr(at, &first, "upload model.toml").success();
    let port = second.port();
    let text = printed(at, &first, move || Deed::LeadTo(port.clone()));
    assert_tells(&text, &["the board was reset in tick ", "encoders count from zero"]);
    assert!(!text.contains("cable"), "{text}");
}
