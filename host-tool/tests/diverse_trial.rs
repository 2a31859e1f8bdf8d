//! `rrr blind-trial --diverse`, end to end.
#![allow(missing_docs)]

use assert_cmd::Command;

#[test]
fn two_diverse_cases_are_drawn_diagnosed_and_scored() {
    let directory = tempfile::tempdir().unwrap();
    let mut command = Command::cargo_bin("rrr").unwrap();
    command.args(["blind-trial", "--diverse", "--cases", "2", "--seed", "4"]);
    command.args(["--duration-scale", "0.3"]).arg("--out").arg(directory.path());
    let output = command.assert().success().get_output().stdout.clone();
    let said = String::from_utf8(output).unwrap();
    let read = |name: &str| std::fs::read_to_string(directory.path().join(name)).unwrap();
    let seal = read("seal.txt");
    assert!(said.contains(seal.split_whitespace().next().unwrap()), "{said}");
    let cases: Vec<serde_json::Value> = read("diverse-trial.jsonl")
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    assert_eq!(cases.len(), 2);
    for case in &cases {
        assert!(case["reality"]["clutter"].as_array().unwrap().len() >= 3, "{case}");
        assert!(case["failure"].is_null(), "{case}");
        assert!(case["processor_seconds"].as_f64().unwrap() > 0.0, "{case}");
    }
    let score: serde_json::Value = serde_json::from_str(&read("diverse-trial.json")).unwrap();
    assert_eq!(score["score"]["answers"]["wrong_name"]["of"], 2);
    assert!(read("diverse-trial.md").contains("## By law of friction"));
    assert!(!directory.path().join("case-001").exists(), "logs are taken away");
}

#[test]
fn what_the_diverse_trial_does_not_take_is_named() {
    let mut command = Command::cargo_bin("rrr").unwrap();
    let assert = command.args(["blind-trial", "--diverse", "--only", "cogging"]).assert().code(2);
    let said = String::from_utf8(assert.get_output().stderr.clone()).unwrap();
    assert!(said.contains("--only"), "{said}");
}
