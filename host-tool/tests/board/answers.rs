//! Answers for programs: one JSON object of every command at a board.

use std::path::Path;

use serde_json::Value;
use simulation::simulated_board::SimulatedBoard;

use crate::{board, rrr, stdout, with_model};

/// What a command answers with.
fn answer(at: &Path, board: &SimulatedBoard, line: &str) -> Value {
    let text = stdout(rrr(at, board, &format!("{line} --json")).success());
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{line}: {error}: {text}"))
}

#[test]
fn every_command_at_a_board_answers_with_one_json_object() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    let of = |line: &str| answer(at, &board, line);
    assert_eq!(of("connect")["state"], "disarmed");
    assert_eq!(of("upload model.toml")["model"], "model.toml");
    assert!(of("download --out block.bin")["bytes"].as_u64() > Some(100));
    assert_eq!(of("home --at 0,-1.5714,0")["position_known"], Value::from(vec![true; 3]));
    assert_eq!(of("run hold --duration 1 --out logs")["finished"], true);
    assert!(of("monitor --once")["position_rad"].is_array());
    assert_eq!(of("stop")["state"], "disarmed");
    assert_eq!(of("clear-fault")["state"], "disarmed");
    assert_eq!(of("set-key rig.key")["needs_key"], true);
}
