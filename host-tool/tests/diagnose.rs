//! `rrr diagnose` from outside: bad input ends it with status 2, and nothing is written.

use std::path::Path;

use assert_cmd::Command;
use diagnosis::Criteria;
use files::RobotFile;
use model::reference_robot::reference_robot;

mod common;
use common::directory;

/// Asserts status 2 and that the message holds these words.
fn assert_refused(directory: &Path, arguments: &[&str], words: &[&str]) {
    let mut rrr = Command::cargo_bin("rrr").unwrap();
    let run = rrr.current_dir(directory).arg("diagnose").args(arguments);
    let assert = run.assert().code(2).stdout("");
    let text = String::from_utf8(assert.get_output().stderr.clone()).unwrap();
    assert!(text.starts_with("error: ") && text.contains("\nhint: "), "{text}");
    for word in words {
        assert!(text.contains(word), "no `{word}` in: {text}");
    }
    assert!(!directory.join("out").exists());
}

#[test]
fn files_that_are_not_there_are_named() {
    let directory = directory();
    let of = ["campaign", "--model", "model.toml", "--out", "out"];
    assert_refused(directory.path(), &of, &["model.toml", "no such file"]);
    RobotFile::from_robot(&reference_robot()).write(directory.path().join("model.toml")).unwrap();
    assert_refused(directory.path(), &of, &["dataset.toml", "no such file"]);
}

#[test]
fn a_log_that_is_broken_is_named() {
    let directory = directory();
    let path = |name: &str| directory.path().join(name);
    RobotFile::from_robot(&reference_robot()).write(path("model.toml")).unwrap();
    std::fs::create_dir(path("campaign")).unwrap();
    let list = "format = 1\n[[log]]\nfile = \"a.csv\"\nexperiment = \"task\"\nrole = \"train\"\n";
    std::fs::write(path("campaign/dataset.toml"), list).unwrap();
    std::fs::write(path("campaign/a.csv"), "t_s,q1_rad,u1_V\n0,0,zero\n").unwrap();
    let of = ["campaign", "--model", "model.toml", "--out", "out"];
    assert_refused(directory.path(), &of, &["a.csv", "line 2", "u1_V", "zero"]);
}

#[test]
fn criteria_that_cannot_be_used_are_named() {
    let directory = directory();
    std::fs::write(directory.path().join("criteria.toml"), "[rows]\nmargin = 1.0\n").unwrap();
    let of = ["campaign", "--model", "m.toml", "--out", "out", "--criteria", "criteria.toml"];
    assert_refused(directory.path(), &of, &["criteria.toml, line 2", "margin", "--print-criteria"]);
}

#[test]
fn printed_criteria_are_the_defaults() {
    let mut rrr = Command::cargo_bin("rrr").unwrap();
    let assert = rrr.args(["diagnose", "--print-criteria"]).assert().success();
    let text = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
    let defaults: Criteria = toml::from_str(&text).unwrap();
    assert_eq!(defaults, Criteria::default());
    assert!(text.contains("# Shortest stretch that is used [s].\nshortest_s = 1.5\n"), "{text}");
}

#[test]
fn the_model_that_is_judged_is_not_replaced() {
    let directory = directory();
    RobotFile::from_robot(&reference_robot()).write(directory.path().join("model.toml")).unwrap();
    let before = std::fs::read(directory.path().join("model.toml")).unwrap();
    let of = [".", "--model", "model.toml", "--out", "."];
    assert_refused(directory.path(), &of, &["model.toml", "would replace it", "another --out"]);
    assert_eq!(before, std::fs::read(directory.path().join("model.toml")).unwrap());
}
