//! The commands of `docs/first-motion.md`, in their order, at a simulated board whose encoders
//! count from zero at power-on.
#![cfg(unix)]
#![allow(missing_docs)]

use std::path::Path;
use std::time::Duration;

use assert_cmd::Command;
use files::{Dataset, Log, RobotFile};
use model::reference_robot::reference_robot;
use simulation::simulated_board::{BoardSettings, SimulatedBoard};

const PAGE: &str = include_str!("../../docs/first-motion.md");

/// The page's commands for a board that is there, from telling home to the task.
fn commands() -> Vec<String> {
    let lines = PAGE.lines().filter_map(|line| line.strip_prefix("    rrr "));
    let wanted = ["home", "upload", "run", "clear-fault", "connect", "set-key", "validate"];
    lines
        .map(|line| line.split('#').next().unwrap_or_default().trim().to_owned())
        .filter(|line| wanted.iter().any(|name| line.split(' ').next() == Some(name)))
        .collect()
}

/// The output of a command that must succeed; the board's time runs faster than the host's.
fn rrr(at: &Path, board: &SimulatedBoard, line: &str) -> String {
    let mut command = Command::cargo_bin("rrr").unwrap();
    command.current_dir(at).args(line.split(' ').filter(|word| !word.is_empty()));
    if !line.starts_with("validate") {
        command.args(["--port", &board.port()]);
    }
    if line.starts_with("run") {
        command.args(["--host-timeout-ms", "8000"]);
    }
    if at.join("rig.key").exists() {
        command.env("RRR_KEY_FILE", "rig.key");
    }
    command.timeout(Duration::from_secs(120));
    let assert = command.assert();
    let output = assert.get_output();
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "rrr {line}: {errors}");
    String::from_utf8(output.stdout.clone()).unwrap()
}

#[test]
fn every_command_of_the_page_does_what_it_says() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    for name in ["model.toml", "identified.toml"] {
        RobotFile::from_robot(&reference_robot()).write(at.join(name)).unwrap();
    }
    // Somebody has held the arm aside while the power came on, and then let go.
    let mut settings = BoardSettings { speed: 4.0, ..BoardSettings::new(reference_robot()) };
    settings.arm.position_rad = [0.0, -1.3, 0.3];
    settings.arm.incremental_encoders = true;
    let board = SimulatedBoard::start(settings).unwrap();
    let commands = commands();
    assert!(commands.len() >= 8, "{commands:?}");
    for line in &commands {
        println!("rrr {line}");
        let text = rrr(at, &board, line);
        if line.starts_with("run") {
            assert!(text.contains("played to its end"), "{line}: {text}");
        }
    }
    for folder in ["first", "task"] {
        let dataset = Dataset::read(at.join(folder)).unwrap();
        for entry in &dataset.entries {
            let rows = Log::read(at.join(folder).join(&entry.file)).unwrap().time_s.len();
            assert!(rows > 1000, "{folder}: {rows} rows");
        }
    }
}
