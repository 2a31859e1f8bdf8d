//! Commands of `rrr` at a simulated board in this process.

use std::path::Path;
use std::time::Duration;

use assert_cmd::assert::Assert;
use link::{Address, Client};
use model::reference_robot::reference_robot;
use simulation::simulated_board::{BoardSettings, SimulatedBoard};

/// A board that was never used, in real time.
pub fn board() -> SimulatedBoard {
    SimulatedBoard::start(BoardSettings::new(reference_robot())).unwrap()
}

/// A conversation with it.
pub fn client(board: &SimulatedBoard) -> Client {
    Client::connect(&Address::of(&board.port()), None).unwrap()
}

/// `rrr` at a port, in a directory, without a key in its environment.
pub fn rrr(directory: &Path, port: &str, line: &str) -> assert_cmd::Command {
    let mut command = assert_cmd::Command::cargo_bin("rrr").unwrap();
    command.current_dir(directory).args(line.split(' ')).args(["--port", port]);
    command.timeout(Duration::from_secs(60)).env_remove("RRR_KEY_FILE");
    command
}

/// What it says on success.
pub fn said(directory: &Path, board: &SimulatedBoard, line: &str) -> String {
    stdout(&rrr(directory, &board.port(), line).assert().success())
}

/// The standard output.
pub fn stdout(assert: &Assert) -> String {
    String::from_utf8(assert.get_output().stdout.clone()).unwrap()
}

/// The error's two lines after exit status 2.
pub fn refused(assert: Assert) -> String {
    let text = String::from_utf8(assert.code(2).get_output().stderr.clone()).unwrap();
    assert!(text.starts_with("error: ") && text.contains("\nhint: "), "{text}");
    text
}

/// Asserts that a text has all of the parts.
pub fn assert_tells(text: &str, parts: &[&str]) {
    parts.iter().for_each(|part| assert!(text.contains(part), "no `{part}` in: {text}"));
}
