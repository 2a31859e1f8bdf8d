//! What is to be seen and what is on disk while the arm moves.

use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use files::Log;
use serialport::{SerialPort, TTYPort};
use simulation::simulated_board::SimulatedBoard;

use crate::line::{Deed, Line, at_query};
use crate::{arguments, assert_tells, board, refused, rrr, rrr_at, spawned, with_model};

const LINE: &str = "run hold --duration 600 --out logs --role train";

/// Waits until the log that grows has so many lines.
fn wait_for_lines(path: &Path, lines: usize) {
    let end = Instant::now() + Duration::from_secs(60);
    while std::fs::read_to_string(path).is_ok_and(|text| text.lines().count() < lines)
        || !path.exists()
    {
        assert!(Instant::now() < end, "{} does not grow", path.display());
        std::thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn a_run_that_is_killed_has_its_log_on_disk_row_by_row() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let growing = at.join("logs/hold.unfinished.csv");
    let mut run: Child = spawned(at, &board.port(), LINE);
    wait_for_lines(&growing, 1000);
    let before = std::fs::read_to_string(&growing).unwrap();
    // As `kill -9` does.
    run.kill().unwrap();
    run.wait().unwrap();
    let text = std::fs::read_to_string(&growing).unwrap();
    assert!(text.starts_with(&before) && text.ends_with('\n'));
    let log = Log::read(&growing).unwrap();
    assert_eq!(log.len() + 1, text.lines().count());
    assert!(log.len() >= 999 && log.joints.len() == 3);
    let files: Vec<_> = std::fs::read_dir(at.join("logs")).unwrap().map(Result::unwrap).collect();
    assert_eq!(files.len(), 1, "it is in no dataset.toml: {files:?}");
}

#[test]
fn a_run_that_is_done_leaves_no_log_that_grew() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    rrr(at, &board, "run task --duration 1 --out logs --approach-speed 3").success();
    let names = std::fs::read_dir(at.join("logs")).unwrap();
    let mut names: Vec<_> = names.map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["dataset.toml", "task.csv.gz", "task.mcap"]);
}

#[test]
fn a_run_whose_link_was_lost_is_never_listed_to_be_fitted_to() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let line = Line::to(&board, at_query(1, 5, || Deed::Silence));
    let text = refused(rrr_at(at, &line.port, LINE));
    assert_tells(&text, &["the link was lost in tick "]);
    assert!(Log::read(at.join("logs/hold.csv.gz")).unwrap().len() > 500);
    assert!(!at.join("logs/dataset.toml").exists(), "the board has ended it with a fault");
}

/// What `rrr run` draws on a terminal.
fn drawn(at: &Path, board: &SimulatedBoard, line: &str) -> String {
    let (mut terminal, end) = TTYPort::pair().unwrap();
    let end_of_rrr = File::options().write(true).open(end.name().unwrap()).unwrap();
    let mut command = Command::new(assert_cmd::cargo::cargo_bin("rrr"));
    command.current_dir(at).args(arguments(&board.port(), line)).env_remove("RRR_KEY_FILE");
    let mut run = command.stdout(end_of_rrr).stderr(Stdio::null()).spawn().unwrap();
    terminal.set_timeout(Duration::from_millis(200)).unwrap();
    let (mut text, mut buffer) = (Vec::new(), [0; 4096]);
    while run.try_wait().unwrap().is_none() {
        let length = terminal.read(&mut buffer).unwrap_or(0);
        text.extend_from_slice(&buffer[..length]);
    }
    while let Ok(length @ 1..) = terminal.read(&mut buffer) {
        text.extend_from_slice(&buffer[..length]);
    }
    String::from_utf8_lossy(&text).into_owned()
}

#[test]
fn the_table_of_monitor_is_drawn_while_the_arm_moves() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let text = drawn(at, &board, "run hold --duration 8 --out logs");
    assert_tells(&text, &["running  tick ", "error_mrad", "pd-model", "fault none", "of 8.0 s"]);
    assert!(text.matches("\x1b[").count() > 4, "several, each over the one before: {text}");
    assert_tells(&text, &["played to its end"]);
}
