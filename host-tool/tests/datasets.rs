//! Data sets: the list, the logs, and what is said of bad ones.

use std::path::Path;

use files::{Dataset, Entry, Experiment, FileError, Role};

mod common;
use common::{directory, log_in_counts, log_in_radians};

const LIST: &str = "format = 1
encoder_counts_per_rev = 655360

[[log]]
file = \"slow.csv.gz\"
experiment = \"slow\"
role = \"train\"

[[log]]
file = \"juggling.mcap\"
experiment = \"juggling\"
role = \"holdout\"
joint = 3
";

fn write_list(directory: &Path, text: &str) {
    std::fs::write(directory.join("dataset.toml"), text).unwrap();
}

fn error_of(text: &str) -> FileError {
    let directory = directory();
    write_list(directory.path(), text);
    Dataset::read(directory.path()).unwrap_err()
}

#[test]
fn the_list_itself_names_its_data_set() {
    let directory = directory();
    write_list(directory.path(), LIST);
    let by_list = Dataset::read(directory.path().join("dataset.toml")).unwrap();
    assert_eq!(by_list, Dataset::read(directory.path()).unwrap());
}

fn assert_says(error: &FileError, parts: &[&str]) {
    let message = error.to_string();
    for part in parts {
        assert!(message.contains(part), "no `{part}` in: {message}");
    }
}

#[test]
fn a_list_is_read_with_unknown_experiments_as_tasks() {
    let directory = directory();
    write_list(directory.path(), LIST);
    let dataset = Dataset::read(directory.path()).unwrap();
    assert_eq!(dataset.encoder_counts_per_rev, Some(655_360.0));
    let [slow, task] = dataset.entries.as_slice() else { panic!("{dataset:?}") };
    assert_eq!((slow.experiment, slow.role, slow.joint), (Experiment::Slow, Role::Train, None));
    assert_eq!(
        (task.experiment, task.role, task.joint),
        (Experiment::Task, Role::Holdout, Some(3))
    );
}

#[test]
fn a_list_survives_with_every_experiment() {
    use Experiment::*;
    let all = [
        (ConstantVelocity, "constant-velocity"),
        (FrictionExcitation, "friction-excitation"),
        (PreslidingNoise, "presliding-noise"),
        (Excitation, "excitation"),
        (Slow, "slow"),
        (DrivenNoise, "driven-noise"),
        (Task, "task"),
    ];
    let entry = |(experiment, name): (Experiment, &str)| Entry {
        file: format!("{name}.csv"),
        experiment,
        role: Role::Train,
        joint: Some(1),
    };
    let directory = directory();
    let dataset = Dataset {
        directory: directory.path().to_owned(),
        encoder_counts_per_rev: Some(655_360.0),
        entries: all.map(entry).to_vec(),
    };
    dataset.write(directory.path()).unwrap();
    assert_eq!(Dataset::read(directory.path()).unwrap(), dataset);
    let text = std::fs::read_to_string(directory.path().join("dataset.toml")).unwrap();
    assert!(text.starts_with("format = 1\nencoder_counts_per_rev = 655360\n\n[[log]]"), "{text}");
    for (_, name) in all {
        assert!(text.contains(&format!("experiment = \"{name}\"")), "{text}");
    }
}

#[test]
fn logs_are_read_in_the_order_of_the_list() {
    let directory = directory();
    write_list(directory.path(), LIST);
    log_in_counts(50).write(directory.path().join("slow.csv.gz")).unwrap();
    log_in_radians().write(directory.path().join("juggling.mcap")).unwrap();
    let dataset = Dataset::read(directory.path()).unwrap();
    let recordings = dataset.recordings().unwrap();
    assert!(recordings[0].log == log_in_counts(50));
    assert!(recordings[1].log == log_in_radians());
    assert_eq!(recordings[0].entry, dataset.entries[0]);
    let expected = 1000.0 * std::f64::consts::TAU / 655_360.0;
    assert!((recordings[0].position_rad(1).unwrap()[0] - expected).abs() < 1e-15);
    assert_eq!(recordings[1].position_rad(3).unwrap()[1], 0.25);
    assert_eq!(recordings[1].position_rad(1), None);
    assert_eq!(dataset.recordings_of(Role::Holdout).unwrap().len(), 1);
}

#[test]
fn a_list_that_is_missing_is_named() {
    let directory = directory();
    let error = Dataset::read(directory.path()).unwrap_err();
    assert_says(&error, &["dataset.toml: there is no such file"]);
}

#[test]
fn a_log_that_is_missing_is_named() {
    let directory = directory();
    write_list(directory.path(), LIST);
    let error = Dataset::read(directory.path()).unwrap().recordings().unwrap_err();
    assert_says(&error, &["slow.csv.gz: there is no such file"]);
}

#[test]
fn a_log_without_its_joint_is_refused() {
    let directory = directory();
    write_list(directory.path(), &LIST.replace("joint = 3", "joint = 2"));
    log_in_counts(5).write(directory.path().join("slow.csv.gz")).unwrap();
    log_in_radians().write(directory.path().join("juggling.mcap")).unwrap();
    let error = Dataset::read(directory.path()).unwrap().recordings().unwrap_err();
    assert_says(&error, &["juggling.mcap", "joint 2, which dataset.toml names"]);
}

#[test]
fn counts_need_the_counts_per_turn() {
    let directory = directory();
    write_list(directory.path(), &LIST.replace("encoder_counts_per_rev = 655360", ""));
    log_in_counts(5).write(directory.path().join("slow.csv.gz")).unwrap();
    let error = Dataset::read(directory.path()).unwrap().recordings().unwrap_err();
    assert_says(&error, &["dataset.toml", "encoder_counts_per_rev", "slow.csv.gz", "missing"]);
}

#[test]
fn bad_lists_are_refused_with_their_line() {
    let says = |from: &str, to: &str, parts: &[&str]| {
        assert_says(&error_of(&LIST.replace(from, to)), &[&["dataset.toml"], parts].concat());
    };
    says("format = 1", "format = 3", &["line 1", "format 3 is not known here"]);
    says("\"train\"", "\"test\"", &["line 7", "unknown variant `test`", "`holdout`"]);
    says("file = \"slow.csv.gz\"\n", "", &["line 4", "missing field `file`"]);
    says("joint = 3", "joint = 4", &["line 9", "joint of juggling.mcap is 4"]);
    says("joint = 3", "joint = 3.5", &["line 13", "3.5"]);
    says("655360", "0", &["line 2", "encoder_counts_per_rev is 0, but must be above 0"]);
    says("655360", "nan", &["line 2", "encoder_counts_per_rev = nan"]);
    says("role = \"train\"", "role = train", &["line 7"]);
    assert_says(&error_of("format = 1\n"), &["[[log]] is missing"]);
}

#[test]
fn collected_data_sets_are_read() {
    let sets = ["rig-1", "dfki-pendulum", "labelled/labelled-1"];
    for path in sets.into_iter().filter_map(test_support::data) {
        let dataset = Dataset::read(&path).unwrap();
        let recordings = dataset.recordings().unwrap();
        assert_eq!(recordings.len(), dataset.entries.len());
        assert!(recordings.iter().all(|recording| recording.position_rad(3).is_some()));
    }
}
