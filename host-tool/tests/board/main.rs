//! A day at the board, by `rrr`'s commands, at a simulated board in this process.
#![cfg(unix)]

use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use assert_cmd::Command;
use host_tool::files::{Dataset, Log, RobotFile, Role};
use host_tool::link::simulated_board::{BoardSettings, SimulatedBoard};
use model::reference_robot::reference_robot;

mod common;
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
    // The board's time runs faster than the host's.
    let patient = if line.starts_with("run") { " --host-timeout-ms 8000" } else { "" };
    let line = format!("{line}{patient}");
    let mut command = Command::cargo_bin("rrr").unwrap();
    command.current_dir(directory).args(line.split(' ')).args(["--port", &board.port()]);
    command.timeout(Duration::from_secs(120)).env_remove("RRR_KEY_FILE").assert()
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
fn a_run_is_recorded_as_a_data_set_that_grows() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let text =
        stdout(rrr(at, &board, "run task --duration 6 --out logs --approach-speed 3").success());
    assert_tells(&text, &["of 6000", "played to its end; 0 V, disarmed"]);
    rrr(at, &board, "run slow --duration 2 --out logs --role train --approach-speed 3").success();
    rrr(at, &board, "run slow --duration 2 --out logs --approach-speed 3").success();

    let dataset = Dataset::read(at.join("logs")).unwrap();
    let entries: Vec<_> = dataset.entries.iter().map(|e| (e.file.as_str(), e.role)).collect();
    let expected = ["task.csv.gz", "slow.csv.gz", "slow-2.csv.gz"];
    let roles = [Role::Holdout, Role::Train, Role::Train];
    assert_eq!(entries, std::iter::zip(expected, roles).collect::<Vec<_>>());
    let recordings = dataset.recordings().unwrap();
    let mcap = Log::read(at.join("logs/task.mcap")).unwrap();
    assert_eq!(recordings[0].log.time_s, mcap.time_s);
    for (csv, mcap) in recordings[0].log.joints.iter().zip(&mcap.joints) {
        assert_eq!(csv.position, mcap.position);
    }
    let bytes = std::fs::read(at.join("logs/task.mcap")).unwrap();
    assert!(bytes.windows(6).any(|part| part == b"/board"), "the board's own channel");
    assert!(recordings[0].log.len() > 5900, "{}", recordings[0].log.len());
    // The arm followed: 0.01 rad is far more than the model leaves, far less than none.
    let joint = recordings[0].log.joint(1).unwrap();
    let reference = joint.reference_rad.as_ref().unwrap();
    let q = joint.position_rad(655_360.0);
    let error = q.iter().zip(reference).map(|(q, r)| (q - r).abs()).fold(0.0, f64::max);
    assert!(error < 0.01, "{error} rad");
    assert!(reference.iter().fold(0.0f64, |most, r| most.max(*r)) > 3.0);

    let mut validate = Command::cargo_bin("rrr").unwrap();
    validate.current_dir(at).args("validate logs --model model.toml --out page".split(' '));
    assert_tells(&stdout(validate.assert().success()), &["task"]);
}

#[test]
fn interrupted_the_arm_is_stopped_first_and_the_log_kept() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let mut child = std::process::Command::new(assert_cmd::cargo::cargo_bin("rrr"))
        .current_dir(at)
        .args(["run", "hold", "--duration", "600", "--out", "logs", "--port", &board.port()])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_secs(3));
    let pressed = Instant::now();
    let id = child.id().to_string();
    std::process::Command::new("kill").args(["-INT", &id]).status().unwrap();
    assert!(child.wait().unwrap().success());
    assert!(pressed.elapsed() < Duration::from_secs(3), "{:?}", pressed.elapsed());
    assert_tells(&stdout(rrr(at, &board, "connect").success()), &["state       disarmed"]);
    let dataset = Dataset::read(at.join("logs")).unwrap();
    assert!(dataset.recordings().unwrap()[0].log.len() > 500);
}

#[test]
fn a_fault_ends_the_run_and_keeps_the_log() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    // Too little voltage to hold against gravity on the way up.
    let line = "run task --out logs --approach-speed 3 --command-limit-v 0.9 --tracking-limit 0.3";
    let text = refused(rrr(at, &board, line));
    assert_tells(&text, &["the board ended the run: ", "rrr clear-fault"]);
    assert_tells(&stdout(rrr(at, &board, "connect").success()), &["state       faulted", "fault "]);
    assert_tells(&refused(rrr(at, &board, "run hold --out logs")), &["the board is faulted"]);
    assert_tells(&stdout(rrr(at, &board, "clear-fault").success()), &["the board is disarmed"]);
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
fn a_noisy_line_costs_time_and_records_and_nothing_else() {
    let directory = with_model();
    let at = directory.path();
    let noisy = BoardSettings { bytes_per_error: Some(1000), speed: 1.0, ..settings() };
    let board = SimulatedBoard::start(noisy).unwrap();
    rrr(at, &board, "upload model.toml").success();
    let text = stdout(rrr(at, &board, "run hold --duration 5 --out logs").success());
    assert_tells(&text, &["played to its end"]);
    let log = Log::read(at.join("logs/hold.csv.gz")).unwrap();
    // 67 bytes a record: some 6 in 100 are broken.
    assert!((4000..5000).contains(&log.len()), "{}", log.len());
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
