//! docs/files.md: its examples are read, and every key, column, topic and field that the readers know
//! stands there.

use std::collections::BTreeSet;
use std::path::Path;

use diagnosis::Criteria;
use files::log::McapDetails;
use files::quantity::{Quantity, Role};
use files::{ArmFile, Dataset, ExcitationFile, FileError, JointLog, Log, Position, RobotFile};
use mcap::MessageStream;
use serde_json::Value;

use crate::rrr::{said, with_model, write};

fn page() -> String {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/files.md");
    std::fs::read_to_string(page).unwrap()
}

/// The examples with the names of their files.
fn examples(page: &str) -> Vec<(String, String)> {
    let blocks = page.split("\n```").skip(1).step_by(2);
    let block = |block: &str| {
        let (head, text) = block.split_once('\n').unwrap();
        (head.split(' ').nth(1).unwrap().to_owned(), format!("{text}\n"))
    };
    blocks.map(block).collect()
}

/// Reads a text as the file of that name is read.
fn read(name: &str, text: &str) -> Result<(), FileError> {
    let bytes = text.as_bytes().to_vec();
    match name {
        "dataset.toml" => Dataset::parse("", bytes).map(drop),
        "robot.toml" | "model.toml" => RobotFile::parse(name, bytes).map(drop),
        "arm.toml" => ArmFile::parse(name, bytes).map(drop),
        "excitation.toml" => ExcitationFile::parse(name, bytes).map(drop),
        "log.csv" => Log::parse(name, bytes).map(drop),
        "states.csv" => Ok(()),
        other => panic!("{other} has no reader"),
    }
}

/// Asserts that the page has a word in code marks, as it stands or as the page says that it is named.
#[track_caller]
fn assert_on_page(page: &str, word: &str) {
    let general = word
        .replace("_kg_m2", "_kg")
        .replace("armature_kg", "armature_kg_m2")
        .replace("limits_m", "limits_rad")
        .replace("N_per_", "Nm_per_")
        .replace("_per_A", "_per_V")
        .replace("_per_m", "_per_rad")
        .replace("velocity_m_", "velocity_rad_");
    let of_volts = ["_Nm", "_N", "_A"].iter().fold(general.clone(), |word, unit| {
        let is_value = ["alpha", "sigma", "limit_"].iter().any(|start| word.starts_with(start));
        if is_value { word.replace(unit, "_V") } else { word }
    });
    let there = [word, &general, &of_volts].iter().any(|name| page.contains(&format!("`{name}`")));
    assert!(there, "docs/files.md does not name `{word}`");
}

#[test]
fn every_example_is_read() {
    let page = page();
    let examples = examples(&page);
    assert!(examples.len() >= 8, "{}", examples.len());
    for (name, text) in &examples {
        read(name, text).unwrap_or_else(|error| panic!("{error}:\n{text}"));
    }
    let text = |wanted: &str| &examples.iter().find(|(name, _)| name == wanted).unwrap().1;
    let directory = with_model();
    write(directory.path(), "states.csv", text("states.csv"));
    let line = ["inverse-dynamics", "--model", "model.toml", "states.csv", "--out", "out.csv"];
    said(directory.path(), &line);
    let out = std::fs::read_to_string(directory.path().join("out.csv")).unwrap();
    for column in out.lines().next().unwrap().split(',').filter(|column| column.contains('1')) {
        assert_on_page(&page, column);
    }
}

/// The keys that a reader knows, table by table: of each an unknown one is asked for.
fn keys(name: &str, text: &str) -> BTreeSet<String> {
    let lines: Vec<&str> = text.lines().collect();
    let mut known = BTreeSet::new();
    let heads = (0..lines.len()).filter(|&k| lines[k].starts_with('[') || k == 0);
    for head in heads {
        let mut lines = lines.clone();
        lines.insert(head + 1, "unheard_of = 1");
        let error = read(name, &lines.join("\n")).expect_err("an unknown key is refused");
        let said = error.to_string();
        let (_, list) = said.split_once("known are ").unwrap_or_else(|| panic!("{said}"));
        known.extend(list.split(", ").map(str::to_owned));
    }
    known
}

#[test]
fn every_key_that_the_readers_know_is_documented() {
    let page = page();
    let whole = with_model();
    let model = std::fs::read_to_string(whole.path().join("model.toml")).unwrap();
    let tables = examples(&page).into_iter().chain([("model.toml".to_owned(), model)]);
    let mut count = 0;
    for (name, text) in tables.filter(|(name, _)| name.ends_with(".toml")) {
        for key in keys(&name, &text) {
            assert_on_page(&page, &key);
            count += 1;
        }
    }
    assert!(count > 80, "{count} keys");
}

#[test]
fn every_column_that_the_readers_know_is_documented() {
    let page = page();
    let roles =
        [Role::Position, Role::Count, Role::Command, Role::Reference, Role::Velocity, Role::Torque];
    let units = ["rad", "m", "count", "V", "A", "Nm", "N", "rad_per_s", "m_per_s"];
    let columns = roles.iter().flat_map(|role| units.map(|unit| Quantity::new(*role, 1, unit)));
    let names: Vec<String> = columns.flatten().map(|quantity| quantity.name()).collect();
    assert!(names.len() >= 13, "{names:?}");
    names.iter().for_each(|name| assert_on_page(&page, name));
    assert_on_page(&page, "t_s");
}

#[test]
fn every_topic_and_field_of_mcap_logs_is_documented() {
    let page = page();
    let directory = tempfile::tempdir().unwrap();
    let joint = JointLog {
        joint: 1,
        position: Position::Count(vec![1, 2]),
        command_v: vec![0.0, 1.0],
        reference_rad: Some(vec![0.0, 0.1]),
    };
    let log = Log { time_s: vec![0.0, 0.001], joints: vec![joint] };
    let details = McapDetails { counts_per_rev: Some(4096.0), ..McapDetails::default() };
    let path = directory.path().join("log.mcap");
    log.write_with(&path, &details).unwrap();
    let bytes = std::fs::read(path).unwrap();
    let mut channels = vec![files::log::Channel::of_board()];
    for message in MessageStream::new(&bytes).unwrap() {
        let channel = message.unwrap().channel;
        let schema = channel.schema.as_ref().unwrap();
        channels.push(files::log::Channel {
            topic: channel.topic.clone(),
            schema_name: schema.name.clone(),
            schema: String::from_utf8(schema.data.to_vec()).unwrap(),
        });
    }
    for channel in channels {
        assert_on_page(&page, &channel.topic);
        assert_on_page(&page, &channel.schema_name);
        let schema: Value = serde_json::from_str(&channel.schema).unwrap();
        for field in schema["properties"].as_object().unwrap().keys() {
            assert_on_page(&page, field);
        }
    }
}

/// All keys of a JSON value, but for those of tables whose keys are names of parameters.
fn json_keys(value: &Value, keys: &mut BTreeSet<String>) {
    match value {
        Value::Object(map) => {
            for (key, value) in map {
                keys.insert(key.clone());
                if !key.starts_with("parameter") || key == "parameters_changed" {
                    json_keys(value, keys);
                }
            }
        }
        Value::Array(values) => values.iter().for_each(|value| json_keys(value, keys)),
        _ => {}
    }
}

#[test]
fn every_key_of_a_report_is_documented() {
    let page = page();
    let directory = with_model();
    let effect = "cogging:3:amplitude_V=0.3,harmonic=8,phase_rad=0.9";
    let line = ["simulate", "--model", "model.toml", "--dataset", "task", "--out", "logs"];
    said(directory.path(), &[&line[..], &["--effect", effect]].concat());
    said(directory.path(), &["diagnose", "logs", "--model", "model.toml", "--out", "out"]);
    let report = std::fs::read_to_string(directory.path().join("out/report.json")).unwrap();
    let mut keys = BTreeSet::new();
    json_keys(&serde_json::from_str(&report).unwrap(), &mut keys);
    assert!(keys.contains("share") && keys.len() > 30, "{keys:?}");
    keys.iter().for_each(|key| assert_on_page(&page, key));
}

#[test]
fn every_criterion_is_printed_with_its_unit_and_read_back() {
    let directory = tempfile::tempdir().unwrap();
    let text = said(directory.path(), &["diagnose", "--print-criteria"]);
    write(directory.path(), "criteria.toml", &text);
    assert_eq!(
        Criteria::read(directory.path().join("criteria.toml")).unwrap(),
        Criteria::default()
    );
}
