//! `rrr identify` on arms of any kind from outside: a model that serves, and bad input.

use std::path::Path;

use assert_cmd::Command;
use files::ArmFile;
use model::mechanism::Mechanism;

#[path = "../identification/tests/arm_simulator/mod.rs"]
mod arm_simulator;
use arm_simulator::{Recorder, forget_links, record, write_dataset};

mod common;
use common::directory;

const LIFT: &str = r#"
format = 2
[robot]
name = "lift with a swinging arm"
[[joint]]
name = "lift"
kind = "prismatic"
axis = [0.0, 0.0, 1.0]
mass_kg = 6.0
com_m = [0.0, 0.0, 0.0]
inertia_kg_m2 = [0.1, 0.0, 0.0, 0.1, 0.0, 0.1]
drive = { kind = "torque" }
encoder = { counts_per_m = 200000 }
friction = { alpha0_V = 6.0, alpha2_V_s_per_m = 15.0 }
[[joint]]
name = "arm"
kind = "revolute"
origin_xyz_m = [0.2, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]
mass_kg = 1.5
com_m = [0.2, 0.0, 0.0]
inertia_kg_m2 = [2e-3, 0.0, 0.0, 2e-2, 0.0, 2e-2]
drive = { kind = "current", torque_constant_Nm_per_A = 2.0 }
encoder = { counts_per_rev = 20000 }
friction = { alpha0_V = 0.2, alpha2_V_s_per_rad = 0.1 }
"#;

const STATES: &str = "q1_m,q2_rad,qd1_m_per_s,qd2_rad_per_s,qdd1_m_per_s2,qdd2_rad_per_s2\n\
    0.1,0.5,0.2,-1.5,1.0,6.0\n-0.2,-1.5,0.1,0.5,-2.0,-8.0\n";

fn rrr(directory: &Path, arguments: &[&str]) -> assert_cmd::assert::Assert {
    Command::cargo_bin("rrr").unwrap().current_dir(directory).args(arguments).assert()
}

fn identify(directory: &Path) -> assert_cmd::assert::Assert {
    rrr(directory, &["identify", "data", "--robot", "robot.toml", "--out", "found/model.toml"])
}

fn recorder(duration_s: f64, seed: u128) -> Recorder {
    Recorder {
        loop_hz: 500,
        every: 1,
        duration_s,
        amplitude: vec![0.25, 1.2],
        middle: vec![0.0, 0.3],
        fastest_hz: 1.2,
        stiffness: vec![4000.0, 60.0],
        noise: 0.002,
        seed,
    }
}

/// A directory with `robot.toml`, of which the links are unknown, and `data`.
fn campaign(duration_s: f64) -> (tempfile::TempDir, ArmFile) {
    let directory = directory();
    let truth = ArmFile::parse("truth.toml", LIFT.into()).unwrap();
    let mut robot = truth.clone();
    forget_links(&mut robot);
    robot.write(directory.path().join("robot.toml")).unwrap();
    let data = directory.path().join("data");
    std::fs::create_dir(&data).unwrap();
    let logs = [1, 2].map(|seed| record(&truth, &recorder(duration_s, seed)));
    write_dataset(&data, &logs);
    (directory, truth)
}

/// Asserts exit status 2, an error with these parts, a hint, and that nothing is written.
fn assert_refused(directory: &Path, parts: &[&str]) {
    let assert = identify(directory).code(2);
    let text = String::from_utf8(assert.get_output().stderr.clone()).unwrap();
    let error = text.lines().find(|line| line.starts_with("error: ")).unwrap_or_default();
    for part in parts {
        assert!(error.contains(part), "no `{part}` in: {text}");
    }
    assert!(text.lines().any(|line| line.starts_with("hint: ")), "{text}");
    assert!(!directory.join("found/model.toml").exists());
}

fn replace(path: &Path, from: &str, to: &str) {
    let text = std::fs::read_to_string(path).unwrap();
    assert!(text.contains(from), "no `{from}` in {text}");
    std::fs::write(path, text.replace(from, to)).unwrap();
}

#[test]
fn what_identify_writes_serves_inverse_dynamics() {
    let (directory, truth) = campaign(25.0);
    let path = directory.path();
    let assert = identify(path).success();
    let text = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
    for part in ["held out", "joint 1 lift", "joint 2 arm", "condition number", "note: joint 1"] {
        assert!(text.contains(part), "no `{part}` in: {text}");
    }
    let summary = std::fs::read_to_string(path.join("found/identification.json")).unwrap();
    assert!(summary.contains("\"standard_error\"") && summary.contains("joint[2].mx_kg_m"));
    std::fs::write(path.join("states.csv"), STATES).unwrap();
    let arguments =
        ["inverse-dynamics", "--model", "found/model.toml", "states.csv", "--out", "torques.csv"];
    rrr(path, &arguments).success().stderr("");
    let torques = std::fs::read_to_string(path.join("torques.csv")).unwrap();
    for (state, found) in STATES.lines().zip(torques.lines()).skip(1) {
        let numbers = |line: &str| -> Vec<f64> {
            line.split(',').map(|number| number.parse().unwrap()).collect()
        };
        let (state, found) = (numbers(state), numbers(found));
        let mut right = [0.0; 2];
        let chain = truth.chain().unwrap();
        chain.inverse_dynamics(&state[..2], &state[2..4], &state[4..], &mut right);
        for (right, found) in right.iter().zip(&found) {
            assert!((right - found).abs() < 0.01 * right.abs(), "{right} {found}");
        }
    }
}

#[test]
fn a_log_without_a_command_is_refused() {
    let (directory, _) = campaign(2.0);
    replace(&directory.path().join("data/0.csv"), "u2_A", "v2_A");
    assert_refused(directory.path(), &["0.csv", "u2_A", "missing"]);
}

#[test]
fn a_log_that_is_too_short_is_refused() {
    let (directory, _) = campaign(0.1);
    assert_refused(directory.path(), &["0.csv", "stretch", "are needed"]);
}

#[test]
fn a_log_of_one_row_is_refused() {
    let (directory, _) = campaign(0.003);
    assert_refused(directory.path(), &["0.csv"]);
}

#[test]
fn joints_that_stand_are_refused() {
    let (directory, _) = campaign(2.0);
    let row = |k: u32| {
        format!("{:.3},100,{:.3},200,0.1\n", 0.002 * f64::from(k), 59.0 + f64::from(k % 7))
    };
    let log =
        "t_s,q1_count,u1_N,q2_count,u2_A\n".to_owned() + &(0..2500).map(row).collect::<String>();
    write_dataset(&directory.path().join("data"), &[log.clone(), log]);
    assert_refused(directory.path(), &["no joint moves"]);
}

#[test]
fn a_position_servo_is_refused_in_words() {
    let (directory, _) = campaign(2.0);
    let robot = directory.path().join("robot.toml");
    replace(&robot, "kind = \"torque\"", "kind = \"position-servo\"");
    replace(&directory.path().join("data/0.csv"), "u1_N", "qref1_m");
    replace(&directory.path().join("data/1.csv"), "u1_N", "qref1_m");
    assert_refused(directory.path(), &["joint 1", "position servo", "voltage, current and torque"]);
}

#[test]
fn a_drive_of_unknown_strength_is_refused() {
    let (directory, _) = campaign(2.0);
    replace(&directory.path().join("robot.toml"), "torque_constant_Nm_per_A = 2.0\n", "");
    assert_refused(directory.path(), &["joint 2", "torque constant"]);
}

#[test]
fn a_data_set_without_logs_to_fit_to_is_refused() {
    let (directory, _) = campaign(2.0);
    replace(&directory.path().join("data/dataset.toml"), "\"train\"", "\"holdout\"");
    assert_refused(directory.path(), &["\"train\""]);
}
