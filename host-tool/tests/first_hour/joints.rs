//! Logs of more joints than the model has.

use std::path::Path;

use crate::rrr::{assert_tells, refused, said, with_model, write};
use test_support::PIVOT;

/// A log of so many joints in the columns of a log.
fn log(joints: usize) -> String {
    let columns = |name: &str, unit: &str| -> String {
        (1..=joints).map(|joint| format!(",{name}{joint}_{unit}")).collect()
    };
    let mut text = format!("t_s{}{}\n", columns("q", "rad"), columns("u", "V"));
    for k in 0..400 {
        let t_s = f64::from(k) / 1e3;
        let at = |joint: usize| format!(",{:.6}", (t_s * (joint + 1) as f64).sin());
        let positions: String = (0..joints).map(at).collect();
        text += &format!("{t_s:.3}{positions}{}\n", ",0.1".repeat(joints));
    }
    text
}

fn with_log(directory: &Path, joints: usize, head: &str) {
    let list = |role: &str| {
        format!("[[log]]\nfile = \"run.csv\"\nexperiment = \"excitation\"\nrole = \"{role}\"\n")
    };
    write(directory, "logs/run.csv", &log(joints));
    let text = format!("format = 1\n{head}{}{}", list("train"), list("holdout"));
    write(directory, "logs/dataset.toml", &text);
}

#[test]
fn logs_of_six_joints_are_not_silently_cut_to_three() {
    let directory = with_model();
    let at = directory.path();
    with_log(at, 6, "");
    for line in [
        "validate logs --model model.toml --out out",
        "diagnose logs --model model.toml --out out",
        "identify logs --robot model.toml --out out/model.toml",
        "identify base-parameters logs --robot model.toml --out out",
    ] {
        let text = refused(at, &line.split(' ').collect::<Vec<_>>());
        assert_tells(&text, &["logs/run.csv: joints 4, 5, 6 are in it", "joints 1 to 3 alone"]);
        assert_tells(&text, &["hint: give the model of that arm", "`joints = [1, 2, 3]`"]);
    }
    assert!(!at.join("out/model.toml").exists());
}

#[test]
fn joints_that_are_not_meant_are_left_out_where_the_list_says_so() {
    let directory = with_model();
    with_log(directory.path(), 6, "joints = [1, 2, 3]\n");
    let of_six = files::Dataset::read(directory.path().join("logs")).unwrap().recordings().unwrap();
    with_log(directory.path(), 3, "");
    let three = files::Dataset::read(directory.path().join("logs")).unwrap().recordings().unwrap();
    assert_eq!(of_six[0].log, three[0].log);
}

#[test]
fn import_says_that_the_model_has_fewer_joints_than_the_logs() {
    let directory = with_model();
    with_log(directory.path(), 6, "");
    let arguments = ["import", "logs", "--force", "--model", "model.toml"];
    let text = said(directory.path(), &arguments);
    assert_tells(&text, &["the logs have 6 joints, the model has 3", "write `joints = [1, 2, 3]`"]);
}

#[test]
fn an_arm_of_one_joint_refuses_logs_of_two() {
    let directory = tempfile::tempdir().unwrap();
    write(directory.path(), "model.toml", PIVOT);
    with_log(directory.path(), 2, "");
    let log = directory.path().join("logs/run.csv");
    let text = std::fs::read_to_string(&log).unwrap().replace("_V", "_Nm");
    std::fs::write(&log, text).unwrap();
    for command in [
        "diagnose logs --model model.toml --out out",
        "identify logs --robot model.toml --out m.toml",
    ] {
        let text = refused(directory.path(), &command.split(' ').collect::<Vec<_>>());
        assert_tells(&text, &["joint 2 is in it, but the model ends with joint 1"]);
    }
}

#[test]
fn inverse_dynamics_of_six_joints_needs_a_model_of_six() {
    let directory = with_model();
    let columns = |name: &str, unit: &str| -> String {
        (1..=6).map(|joint| format!("{name}{joint}_{unit},")).collect()
    };
    let header = columns("q", "rad") + &columns("qd", "rad_per_s") + &columns("qdd", "rad_per_s2");
    let text = format!("{}\n{}\n", header.trim_end_matches(','), ["0"; 18].join(","));
    write(directory.path(), "states.csv", &text);
    let line = "inverse-dynamics --model model.toml states.csv --out out.csv";
    let text = refused(directory.path(), &line.split(' ').collect::<Vec<_>>());
    assert_tells(&text, &["states.csv: joints 4, 5, 6 are in it"]);
}
