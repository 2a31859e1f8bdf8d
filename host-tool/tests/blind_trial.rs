//! `rrr blind-trial`: what it draws, seals, writes and says.
#![allow(missing_docs)]

use std::collections::BTreeMap;
use std::path::Path;

use assert_cmd::Command;
use blind_trial::{
    Case, DrawSettings, Kind, Results, RunSettings, SealedTruth, diagnose_case, draw, logs, output,
};
use diagnosis::{Cause, DataParts, Gap, Report, Verdict};
use files::RobotFile;
use rig::effects::Catalogue;

fn rrr(out: &Path, arguments: &[&str]) -> assert_cmd::assert::Assert {
    let mut command = Command::cargo_bin("rrr").unwrap();
    command.arg("blind-trial").arg("--out").arg(out);
    command.args(["--duration-scale", "0.3"]).args(arguments).assert()
}

fn settings(cases: u32, kind: Option<Kind>, only: &[&str]) -> DrawSettings {
    DrawSettings {
        seed: 5,
        first: 1,
        cases,
        kind,
        only: only.iter().map(|name| (*name).to_owned()).collect(),
        duration_scale: 0.3,
        noise_v: None,
    }
}

fn drawn(settings: &DrawSettings) -> Vec<Case> {
    draw(settings, &Catalogue::standard(), &|| {}).unwrap()
}

#[test]
fn cases_depend_on_seed_and_number_alone() {
    let all = drawn(&settings(3, None, &[]));
    let last = drawn(&DrawSettings { first: 3, cases: 1, ..settings(1, None, &[]) });
    assert_eq!(all[2].causes, last[0].causes);
    assert_eq!(all[2].robot, last[0].robot);
    assert!(all[0].robot != all[1].robot);
    let logs = |case: &Case| case.record().unwrap().remove(2).log;
    assert!(logs(&all[2]) == logs(&last[0]));
}

#[test]
fn kinds_and_effects_are_drawn_as_asked_for() {
    let singles = drawn(&settings(2, None, &["delay", "dac_offset"]));
    assert!(singles.iter().all(|case| case.kind == Kind::Single && case.causes.len() == 1));
    let pairs = drawn(&settings(1, Some(Kind::Pair), &[]));
    assert!(pairs[0].causes.len() == 2 && pairs[0].causes[0].effect != pairs[0].causes[1].effect);
    let foreign = drawn(&settings(1, Some(Kind::Foreign), &["mains_hum"]));
    assert!(foreign[0].causes[0].is_foreign() && foreign[0].causes[0].effect == "mains_hum");
    assert!(drawn(&settings(1, Some(Kind::None), &[]))[0].causes.is_empty());
    assert!(draw(&settings(1, None, &["coging"]), &Catalogue::standard(), &|| {}).is_err());
}

#[test]
fn what_is_drawn_is_detectable() {
    for case in drawn(&settings(3, Some(Kind::Single), &[])) {
        let visibility = case.visibility.unwrap();
        assert!(visibility.is_detectable(), "{}: {visibility:?}", case.causes[0].words());
    }
}

#[test]
fn the_logs_are_those_of_the_gap_and_say_nothing_of_the_truth() {
    let directory = tempfile::tempdir().unwrap();
    let case = &drawn(&settings(1, Some(Kind::Single), &[]))[0];
    logs::write(case, directory.path()).unwrap();
    let campaign = logs::read(directory.path()).unwrap();
    let files: Vec<&str> = campaign.traces.iter().map(|trace| trace.file.as_str()).collect();
    let stems: Vec<&str> = files.iter().map(|file| file.split('.').next().unwrap()).collect();
    assert_eq!(stems, ["excitation", "slow", "driven-noise", "task", "excitation-2"]);
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 7);
    let file = RobotFile::read(directory.path().join("model.toml")).unwrap();
    assert!(file.effects.is_empty() && file.extra.is_empty());
    assert!(file.robot().unwrap() != case.robot, "the model given is a little off");
}

#[test]
fn the_seal_is_told_before_and_fits_after() {
    let directory = tempfile::tempdir().unwrap();
    let cases = drawn(&settings(1, Some(Kind::None), &[]));
    let seal = SealedTruth::new(&cases);
    assert_eq!(seal.hash().len(), 64);
    assert!(seal.hash() != SealedTruth::new(&cases).hash(), "another random number, another hash");
    seal.write_hash(directory.path()).unwrap();
    assert!(!directory.path().join("truth.json").exists());
    seal.reveal(directory.path()).unwrap();
    let hash_file = std::fs::read_to_string(directory.path().join("seal.txt")).unwrap();
    assert!(hash_file.starts_with(seal.hash()));
    assert!(directory.path().join("truth.json").exists());
}

/// Names cogging of joint 3, whatever the logs.
fn fool() -> Report {
    let cause = Cause {
        effect: "cogging".into(),
        joint: 3,
        parameters: BTreeMap::new(),
        parameter_intervals: BTreeMap::new(),
        probability: 0.9,
        confidence: 0.9,
        share: 0.5,
        share_interval: [0.4, 0.6],
        shrinkage: 0.0,
        shrinkage_interval: [0.0, 0.0],
        shrinkage_halves: None,
    };
    Report {
        format: 2,
        verdict: Verdict::Effect,
        causes: vec![cause],
        alternatives: Vec::new(),
        parameters_changed: Vec::new(),
        remainder: Vec::new(),
        data: DataParts::default(),
        gap_shares: Vec::new(),
        gap: Gap { refitted_v: vec![0.01; 3], ..Gap::default() },
        untestable: Vec::new(),
        detectable: Vec::new(),
        remarks: Vec::new(),
        model_fault: None,
        contact: None,
    }
}

#[test]
fn answers_are_scored_and_written() {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().to_owned();
    let run = RunSettings { out: out.clone(), keep_logs: false, ceiling: true };
    let case = &drawn(&settings(1, None, &["dac_offset"]))[0];
    let outcome = diagnose_case(case, &run, &|campaign| {
        assert_eq!(campaign.traces.len(), 5);
        Ok(fool())
    })
    .unwrap();
    assert_eq!(outcome.ceiling_v, Some(vec![0.01; 3]));
    assert_eq!(std::fs::read_dir(&out).unwrap().count(), 0, "logs are taken away");
    let panics = diagnose_case(case, &run, &|_| panic!("as a diagnosis must not")).unwrap();
    let results =
        Results::new(&Catalogue::standard(), &settings(2, None, &[]), "0", vec![outcome, panics]);
    assert_eq!((results.score.singles.right.of, results.score.failed.count), (2, 1));
    output::write(&results, &out).unwrap();
    let page = std::fs::read_to_string(out.join("blind-trial.md")).unwrap();
    assert!(page.contains("| dac_offset") && page.contains("cogging of joint 3 (0.90)"), "{page}");
    let json = std::fs::read_to_string(out.join("blind-trial.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json["cases"][0]["answer"]["report"]["verdict"], "effect");
}

#[test]
fn cases_can_be_drawn_without_a_diagnosis() {
    let directory = tempfile::tempdir().unwrap();
    let assert = rrr(directory.path(), &["--cases", "1", "--only", "cogging", "--draw-only"]);
    let said = String::from_utf8(assert.success().get_output().stdout.clone()).unwrap();
    let hash_file = std::fs::read_to_string(directory.path().join("seal.txt")).unwrap();
    assert!(said.contains(hash_file.split_whitespace().next().unwrap()), "{said}");
    let truth = std::fs::read_to_string(directory.path().join("case-001/truth.json")).unwrap();
    let truth: serde_json::Value = serde_json::from_str(&truth).unwrap();
    assert_eq!(truth["verdict"], "effect");
    assert_eq!(truth["causes"][0]["effect"], "cogging");
    assert!(truth["causes"][0]["parameters"]["amplitude_V"].is_number());
}

#[test]
fn bad_arguments_are_named() {
    let directory = tempfile::tempdir().unwrap();
    for (arguments, word) in [
        (["--only", "coging"], "coging"),
        (["--duration-scale", "0"], "--duration-scale"),
        (["--noise-mV", "-1"], "--noise-mV"),
        (["--kind", "triple"], "triple"),
    ] {
        let mut command = Command::cargo_bin("rrr").unwrap();
        command.current_dir(directory.path()).arg("blind-trial");
        let argument = format!("{}={}", arguments[0], arguments[1]);
        let assert = command.arg(argument).assert().code(2);
        let said = String::from_utf8(assert.get_output().stderr.clone()).unwrap();
        assert!(said.contains(word), "{said}");
    }
}
