//! `rrr simulate`: what it writes, and what it says of bad input.
#![allow(missing_docs)]

use std::path::Path;

use assert_cmd::Command;
use files::{Dataset, RobotFile};
use model::reference_robot::reference_robot;
use rig::effects::Catalogue;

fn rrr(directory: &Path, arguments: &[&str]) -> assert_cmd::assert::Assert {
    let model = directory.join("model.toml");
    RobotFile::from_robot(&reference_robot()).write(&model).unwrap();
    let mut command = Command::cargo_bin("rrr").unwrap();
    command.current_dir(directory).args(["simulate", "--model", "model.toml", "--out", "logs"]);
    command.args(arguments).assert()
}

/// What it says, after it has ended with status 2 and left nothing behind.
fn refusal(arguments: &[&str]) -> String {
    let directory = tempfile::tempdir().unwrap();
    let assert = rrr(directory.path(), arguments).code(2);
    assert!(!directory.path().join("logs").exists());
    String::from_utf8(assert.get_output().stderr.clone()).unwrap()
}

#[test]
fn the_gap_data_set_has_three_logs_to_train_and_two_to_hold_out() {
    let directory = tempfile::tempdir().unwrap();
    rrr(directory.path(), &["--dataset", "gap"]).success();
    let dataset = Dataset::read(directory.path().join("logs")).unwrap();
    let recordings = dataset.recordings().unwrap();
    let seconds: Vec<f64> = recordings.iter().map(|r| r.log.duration_s().round()).collect();
    assert_eq!(seconds, [20.0, 20.0, 12.0, 10.0, 10.0]);
}

#[test]
fn csv_and_mcap_hold_the_same_log() {
    let directory = tempfile::tempdir().unwrap();
    let logs: Vec<_> = ["csv", "csv-gz", "mcap"]
        .iter()
        .map(|format| {
            rrr(directory.path(), &["--dataset", "task", "--format", format]).success();
            let dataset = Dataset::read(directory.path().join("logs")).unwrap();
            dataset.recordings().unwrap().remove(0).log
        })
        .collect();
    assert!(logs[0] == logs[1], "plain and compressed text hold the same");
    assert!(logs[0].joints[1].position == logs[2].joints[1].position, "counts are exact");
    let (text, mcap) = (&logs[0].joints[1].command_v, &logs[2].joints[1].command_v);
    let apart = text.iter().zip(mcap).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(text.len() == mcap.len() && apart <= 5.1e-7, "text has six decimals: {apart}");
}

#[test]
fn the_effects_of_the_model_are_compensated_on_request() {
    let directory = tempfile::tempdir().unwrap();
    let mut file = RobotFile::from_robot(&reference_robot());
    for text in ["dac_offset:2:offset_V=0.5", "delay:1:delay_s=0.001"] {
        file.effects.push(rig::effects::table_from_text(text).unwrap());
    }
    file.write(directory.path().join("known.toml")).unwrap();
    // The voltage that holds joint 2 at the start is the other's less the offset.
    let first_v = |more: &[&str]| {
        let fixed = ["--model", "known.toml", "--dataset", "task", "--mode", "pd-model"];
        let mut command = Command::cargo_bin("rrr").unwrap();
        command.current_dir(directory.path()).arg("simulate").args(fixed);
        let assert = command.args(["--out", "logs"]).args(more).assert().success();
        let output = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
        let dataset = Dataset::read(directory.path().join("logs")).unwrap();
        (dataset.recordings().unwrap().remove(0).log.joints[1].command_v[0], output)
    };
    let ((without_v, _), (with_v, output)) = (first_v(&[]), first_v(&["--compensate"]));
    assert!((with_v - without_v + 0.5).abs() < 1e-3, "{without_v} {with_v}");
    assert!(output.contains("delay of joint 1 is not compensated"), "{output}");
}

#[test]
fn unknown_names_are_answered_with_the_known_ones() {
    let message = refusal(&["--dataset", "tusk"]);
    assert!(message.contains("tusk") && message.contains("task"), "{message}");
    let message = refusal(&["--dataset", "task", "--mode", "pid"]);
    assert!(message.contains("--mode pid") && message.contains("pd-friction"), "{message}");
    let message = refusal(&["--dataset", "task", "--effect", "coging:3:amplitude_V=1"]);
    assert!(message.contains("coging") && message.contains("cogging"), "{message}");
}

#[test]
fn a_model_that_is_no_robot_is_refused_by_name() {
    let directory = tempfile::tempdir().unwrap();
    let mut robot = reference_robot::<f64>();
    robot.friction[1].alpha1_v = -1.0;
    RobotFile::from_robot(&robot).write(directory.path().join("bad.toml")).unwrap();
    let arguments = ["simulate", "--model", "bad.toml", "--dataset", "task", "--out", "logs"];
    let mut command = Command::cargo_bin("rrr").unwrap();
    let assert = command.current_dir(directory.path()).args(arguments).assert().code(2);
    let message = String::from_utf8(assert.get_output().stderr.clone()).unwrap();
    assert!(message.contains("bad.toml") && message.contains("alpha1_V of joint 2"), "{message}");
}

#[test]
fn the_page_of_effects_names_them_all() {
    let page = include_str!("../../docs/effects.md");
    for effect in Catalogue::standard().iter() {
        let row = page.lines().find(|line| line.starts_with(&format!("| `{}`", effect.name)));
        let row = row.unwrap_or_else(|| panic!("{} is missing", effect.name));
        assert!(row.contains(effect.words), "{row}");
        assert!(effect.parameters.iter().all(|parameter| row.contains(parameter.name)), "{row}");
    }
}
