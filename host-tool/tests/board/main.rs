//! A day at the board, by `rrr`'s commands, at a simulated board in this process.
#![cfg(unix)]

use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use ::files::RobotFile;
use assert_cmd::Command;
use model::reference_robot::reference_robot;
use simulation::simulated_board::{BoardSettings, SimulatedBoard};

mod answers;
#[path = "../common/mod.rs"]
mod common;
mod endings;
mod files;
mod line;
mod link_lost;
mod live;
mod recording;

use common::directory;

/// Faster than real time, as long as this machine keeps up.
const SPEED: f64 = 4.0;

fn settings() -> BoardSettings {
    BoardSettings { speed: SPEED, ..BoardSettings::new(reference_robot()) }
}

fn board() -> SimulatedBoard {
    SimulatedBoard::start(settings()).unwrap()
}

fn rrr(directory: &Path, board: &SimulatedBoard, line: &str) -> assert_cmd::assert::Assert {
    rrr_at(directory, &board.port(), line)
}

fn rrr_at(directory: &Path, port: &str, line: &str) -> assert_cmd::assert::Assert {
    let mut command = Command::cargo_bin("rrr").unwrap();
    command.current_dir(directory).args(arguments(port, line));
    command.timeout(Duration::from_secs(120)).env_remove("RRR_KEY_FILE").assert()
}

/// `rrr` that goes on beside the test.
fn spawned(directory: &Path, port: &str, line: &str) -> std::process::Child {
    let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin("rrr"));
    command.current_dir(directory).args(arguments(port, line)).env_remove("RRR_KEY_FILE");
    command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

fn arguments(port: &str, line: &str) -> Vec<String> {
    // The board's time runs faster than the host's.
    let patient = if line.starts_with("run") { " --host-timeout-ms 8000" } else { "" };
    format!("{line}{patient} --port {port}").split(' ').map(str::to_owned).collect()
}

fn stdout(assert: assert_cmd::assert::Assert) -> String {
    String::from_utf8(assert.get_output().stdout.clone()).unwrap()
}

/// The error's two lines after exit status 2.
fn refused(assert: assert_cmd::assert::Assert) -> String {
    let text = String::from_utf8(assert.code(2).get_output().stderr.clone()).unwrap();
    assert!(text.starts_with("error: ") && text.contains("\nhint: "), "{text}");
    text
}

fn assert_tells(text: &str, parts: &[&str]) {
    parts.iter().for_each(|part| assert!(text.contains(part), "no `{part}` in: {text}"));
}

/// A directory with a model file.
fn with_model() -> tempfile::TempDir {
    let directory = directory();
    RobotFile::from_robot(&reference_robot()).write(directory.path().join("model.toml")).unwrap();
    directory
}

#[test]
fn connect_tells_what_is_there_and_upload_survives_the_power_cut() {
    let (directory, first) = (with_model(), board());
    let at = directory.path();
    let text = stdout(rrr(at, &first, "connect").success());
    assert_tells(&text, &["simulated, build", "state       disarmed", "safe defaults", "open: "]);
    assert_tells(&refused(rrr(at, &first, "download --out a.bin")), &["nothing valid is stored"]);
    assert_tells(&refused(rrr(at, &first, "run hold --out d")), &["rrr upload"]);
    assert!(!at.join("d").exists(), "no directory without a log");

    let text = stdout(rrr(at, &first, "upload model.toml").success());
    assert_tells(&text, &["the same byte for byte", "the newest in the store"]);
    rrr(at, &first, "download --out a.bin").success();
    let flash = first.switch_off();

    let second = SimulatedBoard::start(BoardSettings { flash, ..settings() }).unwrap();
    assert_tells(&stdout(rrr(at, &second, "connect").success()), &["the newest in the store"]);
    rrr(at, &second, "download --out b.bin").success();
    assert_eq!(std::fs::read(at.join("a.bin")).unwrap(), std::fs::read(at.join("b.bin")).unwrap());
    rrr(at, &second, "download --out model-back.toml").success();
    let [sent, back] = ["model.toml", "model-back.toml"]
        .map(|name| RobotFile::read(at.join(name)).unwrap().robot().unwrap());
    assert!((sent.base.zz1r - back.base.zz1r).abs() < 1e-6);
}

#[test]
fn with_a_key_nobody_else_uploads_or_arms() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    assert_tells(&stdout(rrr(at, &board, "set-key key").success()), &["needs the key"]);
    for line in ["upload model.toml", "set-key --remove"] {
        assert_tells(&refused(rrr(at, &board, line)), &["has a key", "--key FILE"]);
    }
    std::fs::write(at.join("wrong"), "00".repeat(32)).unwrap();
    refused(rrr(at, &board, "upload model.toml --key wrong"));
    std::fs::write(at.join("short"), "00").unwrap();
    assert_tells(&refused(rrr(at, &board, "connect --key short")), &["64 hexadecimal digits"]);
    rrr(at, &board, "upload model.toml --key key").success();
    rrr(at, &board, "run hold --duration 1 --out logs --key key").success();
    assert_tells(&refused(rrr(at, &board, "run hold --duration 1 --out logs")), &["--key FILE"]);
    rrr(at, &board, "stop").success();
    assert_tells(&stdout(rrr(at, &board, "set-key --remove --key key").success()), &["open: "]);
    rrr(at, &board, "upload model.toml").success();
}

#[test]
fn monitor_shows_a_table_and_bad_input_has_words() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    let text = stdout(rrr(at, &board, "monitor --once").success());
    assert_tells(&text, &["disarmed", "position_rad", "error_mrad", "-1.57", "fault none"]);
    for (line, part) in [
        ("run constant-velocity --out logs", "--joint is missing"),
        ("run task --joint 2 --out logs", "--joint 2: not with this experiment"),
        ("run task --mode best --out logs", "no such mode"),
        ("run constant-velocity --joint 1 --duration 5 --out logs", "--duration: not with this"),
        ("run friction-excitation --duration 5 --out logs", "--duration: not with this"),
        ("run presliding-noise --joint 1 --duration 5 --out logs", "--duration: not with this"),
        ("upload nothing.toml", "nothing.toml"),
        ("download --out model.txt", "neither in .bin nor in .toml"),
    ] {
        assert_tells(&refused(rrr(at, &board, line)), &[part]);
    }
    let port = "tcp:127.0.0.1:1";
    let mut command = Command::cargo_bin("rrr").unwrap();
    let text = refused(command.args(["connect", "--port", port]).assert());
    assert_tells(&text, &[port, "cannot be opened"]);
}

#[test]
fn completions_name_the_commands() {
    for shell in ["bash", "zsh", "fish"] {
        let mut command = Command::cargo_bin("rrr").unwrap();
        let text = stdout(command.args(["completions", shell]).assert().success());
        assert_tells(&text, &["upload", "presliding-noise"]);
    }
}
