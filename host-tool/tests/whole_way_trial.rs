//! `rrr blind-trial --whole-way`, end to end: record, identify, a change, record, diagnose.
#![allow(missing_docs)]

use assert_cmd::Command;

#[test]
fn a_robot_is_identified_changed_and_diagnosed() {
    let directory = tempfile::tempdir().unwrap();
    let mut command = Command::cargo_bin("rrr").unwrap();
    command.args(["blind-trial", "--whole-way", "--robots", "1", "--first", "2", "--seed", "3"]);
    command.args(["--only", "payload", "--duration-scale", "0.5"]);
    command.arg("--out").arg(directory.path()).assert().success();
    let read = |name: &str| std::fs::read_to_string(directory.path().join(name)).unwrap();
    let robot: serde_json::Value = serde_json::from_str(read("whole-way.jsonl").trim()).unwrap();
    assert!(robot["failure"].is_null(), "{robot}");
    assert_eq!(robot["truth"][0]["effect"], "payload");
    assert!(robot["visibility"]["raw"].as_f64().unwrap() > 1.7, "{robot}");
    for left_v in robot["held_out_V"].as_array().unwrap() {
        assert!(left_v.as_f64().unwrap() < 0.03, "{robot}");
    }
    let score: serde_json::Value = serde_json::from_str(&read("whole-way.json")).unwrap();
    assert_eq!(score["named_first"]["of"], 1);
    assert!(read("whole-way.md").contains("## By law of friction"));
    assert!(!directory.path().join("case-002").exists(), "logs are taken away");
}

#[test]
fn one_kind_of_trial_at_a_time() {
    let directory = tempfile::tempdir().unwrap();
    let mut command = Command::cargo_bin("rrr").unwrap();
    command.args(["blind-trial", "--whole-way", "--diverse"]).arg("--out").arg(directory.path());
    let assert = command.assert().code(2);
    let said = String::from_utf8(assert.get_output().stderr.clone()).unwrap();
    assert!(said.contains("--diverse"), "{said}");
}
