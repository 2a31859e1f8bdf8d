//! The commands of `docs/practice.md`, at the board that `rrr simulate-board` offers.
#![cfg(unix)]
#![allow(missing_docs)]

#[allow(dead_code)]
#[path = "common/simulated_board.rs"]
mod simulated_board;

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use files::RobotFile;
use model::reference_robot::reference_robot;
use simulated_board::assert_tells;

const PAGE: &str = include_str!("../../docs/practice.md");

/// `rrr simulate-board`, and the port at which it says that its line is.
struct Offered {
    program: Child,
    port: String,
}

impl Offered {
    fn start(at: &Path, line: &str) -> Self {
        let mut command = Command::new(assert_cmd::cargo::cargo_bin("rrr"));
        command.current_dir(at).args(line.split(' ')).stdout(Stdio::piped());
        let mut program = command.spawn().unwrap();
        let mut said = String::new();
        BufReader::new(program.stdout.take().unwrap()).read_line(&mut said).unwrap();
        let port = said.split("--port ").nth(1).and_then(|rest| rest.split(';').next());
        let port = port.unwrap_or_else(|| panic!("{said}")).to_owned();
        Self { program, port }
    }

    /// Ends it by Ctrl-C; it must succeed.
    fn end(mut self) {
        let id = self.program.id().to_string();
        Command::new("kill").args(["-INT", &id]).status().unwrap();
        assert!(self.program.wait().unwrap().success());
    }

    fn rrr(&self, at: &Path, line: &str) -> String {
        let mut command = assert_cmd::Command::cargo_bin("rrr").unwrap();
        command.current_dir(at).args(line.split_whitespace()).env_remove("RRR_KEY_FILE");
        if !["validate", "diagnose"].iter().any(|name| line.starts_with(name)) {
            command.args(["--port", &self.port]);
        }
        if line.starts_with("run") {
            command.args(["--host-timeout-ms", "8000"]);
        }
        let assert = command.timeout(Duration::from_secs(120)).assert();
        let output = assert.get_output();
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "rrr {line}: {errors}");
        String::from_utf8(output.stdout.clone()).unwrap()
    }
}

/// The page's commands after the one that offers the board, without their port and remarks.
fn commands() -> Vec<String> {
    let lines = PAGE.lines().filter_map(|line| line.strip_prefix("    rrr "));
    let bare = lines.map(|line| line.split(['#', '$']).next().unwrap_or_default().trim());
    bare.filter(|line| !line.starts_with("simulate-board") && !line.starts_with("monitor"))
        .map(str::to_owned)
        .collect()
}

fn directory() -> tempfile::TempDir {
    let directory = tempfile::tempdir().unwrap();
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/practice/model.toml");
    std::fs::copy(model, directory.path().join("model.toml")).unwrap();
    directory
}

#[test]
fn every_command_of_the_page_does_what_it_says() {
    let directory = directory();
    let at = directory.path();
    let offer = PAGE.lines().find_map(|line| line.strip_prefix("    rrr simulate-board")).unwrap();
    let effects = offer.split_once("--effect").map_or("", |(_, rest)| rest);
    // Faster than the page has it, so the host may be late.
    let line = format!("simulate-board --tcp 0 --speed 4 --model model.toml --effect{effects}");
    let board = Offered::start(at, &line);
    let commands = commands();
    assert!(commands.len() >= 6, "{commands:?}");
    for line in &commands {
        let text = board.rrr(at, line);
        assert!(!line.starts_with("run") || text.contains("played to its end"), "{line}: {text}");
        assert!(!line.starts_with("diagnose") || text.contains("cogging"), "{line}: {text}");
    }
    board.end();
}

#[test]
fn a_board_keeps_its_flash_and_does_not_know_where_its_arm_is() {
    let directory = directory();
    let at = directory.path();
    let line = "simulate-board --tcp 0 --incremental-encoders --flash flash.bin";
    let board = Offered::start(at, line);
    board.rrr(at, "upload model.toml");
    board.rrr(at, "download --in-use --out first.bin");
    board.end();
    let board = Offered::start(at, line);
    assert_tells(
        &board.rrr(at, "connect"),
        &["unknown for joint 1, 2, 3", "the newest in the store"],
    );
    board.rrr(at, "download --in-use --out second.bin");
    let [first, second] = ["first.bin", "second.bin"].map(|name| std::fs::read(at.join(name)));
    assert_eq!(first.unwrap(), second.unwrap());
    board.end();
}

#[test]
fn what_cannot_be_simulated_is_refused_with_a_cure() {
    let directory = directory();
    let at = directory.path();
    std::fs::write(at.join("short.bin"), [0; 3]).unwrap();
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port();
    for (line, parts) in [
        ("--effect cogs:3:a=1".to_owned(), ["cogs", "docs/effects.md"]),
        ("--model none.toml".to_owned(), ["none.toml", "hint: "]),
        ("--tcp 0 --flash short.bin".to_owned(), ["short.bin: 3 bytes", "that is not there yet"]),
        (format!("--tcp {port}"), ["in use", "0 takes one that is free"]),
        ("--speed 0".to_owned(), ["--speed", "from 0.01 to 100"]),
    ] {
        let mut command = assert_cmd::Command::cargo_bin("rrr").unwrap();
        command.current_dir(at).arg("simulate-board").args(line.split(' '));
        let assert = command.timeout(Duration::from_secs(20)).assert().code(2);
        assert_tells(&String::from_utf8_lossy(&assert.get_output().stderr), &parts);
    }
}

#[test]
fn the_model_to_practise_with_is_the_reference_robot() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/practice/model.toml");
    if std::env::var_os("RRR_WRITE_DOCS").is_some() {
        RobotFile::from_robot(&reference_robot()).write(&path).unwrap();
    }
    let kept = RobotFile::read(path).unwrap();
    assert_eq!(kept.robot().unwrap(), reference_robot());
}
