//! `rrr diagnose` and `rrr identify` on an arm of position servos, from outside.

use std::fmt::Write as _;
use std::path::Path;

use assert_cmd::Command;
use files::{ArmFile, ArmLog, Role};
use servo::prepared;
use servo::recorded::{Recording, Truth, record};
use servo::synthetic::{links_of, pendulum};

mod common;
use common::directory;

fn rrr(directory: &Path, arguments: &[&str]) -> assert_cmd::assert::Assert {
    Command::cargo_bin("rrr").unwrap().current_dir(directory).args(arguments).assert()
}

fn csv(log: &ArmLog) -> String {
    let mut text = "t_s,q1_rad,qref1_rad\n".to_owned();
    let joint = &log.joints[0];
    for (row, t) in log.time_s.iter().enumerate() {
        writeln!(text, "{t:.6},{:.6},{:.6}", joint.position[row], joint.command[row]).unwrap();
    }
    text
}

/// A pendulum whose model has 0.4 kg and whose logs were recorded with 0.6 kg.
fn exchanged(directory: &Path) {
    let truth = pendulum(41, 0.6, 0.15);
    let recording =
        Recording { length_s: 24.0, logs: [4, 2], swing_rad: 1.5, ..Recording::default() };
    let servos = prepared::joints(&truth).unwrap();
    let campaign = record(&truth, &Truth::of(links_of(&truth), servos), &recording, 41);
    let data = directory.join("data");
    std::fs::create_dir(&data).unwrap();
    let mut list = "format = 1\n".to_owned();
    for recording in &campaign.recordings {
        let role = if recording.role == Role::Train { "train" } else { "holdout" };
        let file = &recording.file;
        writeln!(list, "[[log]]\nfile = \"{file}\"\nexperiment = \"task\"\nrole = \"{role}\"")
            .unwrap();
        std::fs::write(data.join(file), csv(&recording.log)).unwrap();
    }
    std::fs::write(data.join("dataset.toml"), list).unwrap();
    pendulum(41, 0.4, 0.15).write(directory.join("model.toml")).unwrap();
}

#[test]
fn an_exchanged_mass_is_reported_and_written() {
    let directory = directory();
    let path = directory.path();
    exchanged(path);
    rrr(path, &["diagnose", "data", "--model", "model.toml", "--out", "out"]).success();
    let text = std::fs::read_to_string(path.join("out/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!((report["format"].as_u64(), report["verdict"].as_str()), (Some(2), Some("effect")));
    let cause = &report["causes"][0];
    assert_eq!((cause["effect"].as_str(), cause["joint"].as_u64()), (Some("payload"), Some(0)));
    let mass = cause["parameters"]["mass_kg"].as_f64().unwrap();
    assert!((mass - 0.2).abs() < 0.02, "{mass}");
    assert!(
        report["gap"]["with_effects_rad"][0].as_f64() < report["gap"]["as_given_rad"][0].as_f64()
    );
    assert!(std::fs::read_to_string(path.join("out/report.html")).unwrap().contains("<svg"));
    let model = ArmFile::read(path.join("out/model.toml")).unwrap();
    assert!(model.effects.iter().any(|table| table.effect == "payload"));
    rrr(path, &["identify", "data", "--robot", "out/model.toml", "--out", "again/model.toml"])
        .success();
}

#[test]
fn a_simulated_arm_hides_what_it_is_told_to() {
    let directory = directory();
    let path = directory.path();
    pendulum(41, 0.4, 0.15).write(path.join("model.toml")).unwrap();
    let record = ["simulate", "--model", "model.toml", "--dataset", "gap", "--seed", "3", "--out"];
    let with = |out: &str, effect: &str| {
        let hidden = ["--effect", effect];
        rrr(path, &[&record[..], &[out][..], &hidden[..]].concat())
    };
    with("logs", "payload:mass_kg=0.2,com_m=0 0 -0.15").success();
    let log = std::fs::read_to_string(path.join("logs/motion-01.csv")).unwrap();
    assert!(log.starts_with("t_s,q1_count,qref1_rad\n"), "{}", &log[..40]);
    rrr(path, &["diagnose", "logs", "--model", "model.toml", "--out", "out"]).success();
    let text = std::fs::read_to_string(path.join("out/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(report["causes"][0]["effect"].as_str(), Some("payload"), "{text}");
    for (effect, words) in [
        ("joint_elasticity:1:stiffness_Nm_per_rad=9", "cannot be simulated on position servos"),
        ("saturation:1:limit_V=-3", "limit_V of saturation is not from 0.0001"),
        ("saturation:2:limit_V=3", "saturation of joint 2"),
        ("goal_clip:1:lowest_rad=1,highest_rad=-1", "goal_clip of joint 1"),
    ] {
        let refused = with("none", effect).code(2);
        let said = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(said.contains(words), "{said}");
    }
    assert!(!path.join("none").exists());
}

#[test]
fn a_servo_without_its_law_is_refused() {
    let directory = directory();
    let path = directory.path();
    exchanged(path);
    let model = std::fs::read_to_string(path.join("model.toml")).unwrap();
    let without: Vec<&str> = model.lines().filter(|line| !line.contains("stiffness_V")).collect();
    std::fs::write(path.join("model.toml"), without.join("\n")).unwrap();
    let refused =
        rrr(path, &["diagnose", "data", "--model", "model.toml", "--out", "out"]).failure();
    let words = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(words.contains("stiffness_V_per_rad"), "{words}");
    assert!(!path.join("out").exists());
}
