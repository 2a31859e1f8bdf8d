//! `rrr simulate` and folders that hold something.

use crate::rrr::{assert_tells, refused, said, with_model, write};

const LIST: &str = "format = 1\nencoder_counts_per_rev = 655360\n\
    [[log]]\nfile = \"task.csv.gz\"\nexperiment = \"task\"\nrole = \"holdout\"\n";
const SIMULATE: [&str; 7] =
    ["simulate", "--model", "model.toml", "--dataset", "task", "--out", "rig"];

#[test]
fn simulate_into_a_folder_with_logs_of_the_rig_leaves_them_and_their_list() {
    let directory = with_model();
    let at = directory.path();
    write(at, "rig/dataset.toml", LIST);
    write(at, "rig/task.csv.gz", "of the rig");
    let text = refused(at, &SIMULATE);
    assert_tells(&text, &["rig/dataset.toml: lists task.csv.gz, which was not simulated"]);
    assert_tells(&text, &["hint: give another --out"]);
    assert_eq!(std::fs::read_to_string(at.join("rig/dataset.toml")).unwrap(), LIST);
    assert_eq!(std::fs::read_to_string(at.join("rig/task.csv.gz")).unwrap(), "of the rig");
}

#[test]
fn simulate_of_an_arm_leaves_them_too() {
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    write(at, "model.toml", test_support::PIVOT);
    write(at, "rig/dataset.toml", LIST);
    let arguments = SIMULATE.map(|word| if word == "task" { "gap" } else { word });
    assert_tells(&refused(at, &arguments), &["which was not simulated"]);
}

#[test]
fn a_log_without_a_list_is_not_written_over() {
    let directory = with_model();
    write(directory.path(), "rig/task.csv.gz", "of the rig");
    let text = refused(directory.path(), &SIMULATE);
    assert_tells(&text, &["rig/task.csv.gz: is there already, and in no list of simulated logs"]);
}

#[test]
fn simulated_logs_take_the_place_of_simulated_ones() {
    let directory = with_model();
    said(directory.path(), &SIMULATE);
    let list = || std::fs::read_to_string(directory.path().join("rig/dataset.toml")).unwrap();
    assert!(list().contains("simulated = true"), "{}", list());
    said(directory.path(), &SIMULATE);
    let with_log_of_rig = list() + LIST.split_once("655360\n").unwrap().1;
    write(directory.path(), "rig/dataset.toml", &with_log_of_rig);
    refused(directory.path(), &SIMULATE);
    assert_eq!(list(), with_log_of_rig);
}
