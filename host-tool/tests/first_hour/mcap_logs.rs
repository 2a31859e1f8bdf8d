//! MCAP logs as Foxglove shows them.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use assert_cmd::cargo::cargo_bin;
use files::{Log, Position};
use mcap::MessageStream;
use serde_json::Value;

use crate::rrr::{said, with_model};

const BEGAN_S: u64 = 1_700_000_000;

fn simulate(directory: &Path, format: &str, out: &str) {
    let line = ["simulate", "--model", "model.toml", "--dataset", "task", "--format", format];
    let mut command = Command::new(cargo_bin("rrr"));
    command.current_dir(directory).args(line).args(["--out", out]);
    let run = command.env("SOURCE_DATE_EPOCH", BEGAN_S.to_string()).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
}

/// Messages by topic, with their times [ns].
fn messages(path: &Path) -> BTreeMap<String, Vec<(u64, Value)>> {
    let bytes = std::fs::read(path).unwrap();
    let mut all: BTreeMap<String, Vec<(u64, Value)>> = BTreeMap::new();
    for message in MessageStream::new(&bytes).unwrap() {
        let message = message.unwrap();
        let value = serde_json::from_slice(&message.data).unwrap();
        all.entry(message.channel.topic.clone()).or_default().push((message.log_time, value));
    }
    all
}

#[test]
fn mcap_logs_hold_radians_velocity_and_error_at_the_time_of_the_wall() {
    let directory = with_model();
    simulate(directory.path(), "mcap", "logs");
    let all = messages(&directory.path().join("logs/task.mcap"));
    let (time_ns, first) = &all["/joint2"][0];
    assert_eq!(*time_ns, BEGAN_S * 1_000_000_000);
    assert!(first.get("position_count").is_none(), "{first}");
    let at = |row: usize, key: &str| all["/joint2"][row].1[key].as_f64().unwrap();
    for row in [100, 5000] {
        let speed = (at(row + 1, "position_rad") - at(row - 1, "position_rad")) / 2e-3;
        assert!((at(row, "velocity_rad_per_s") - speed).abs() < 2e-6);
        let error = at(row, "reference_rad") - at(row, "position_rad");
        assert!((at(row, "error_rad") - error).abs() < 2e-9);
        assert!(at(row, "command_V").abs() <= 10.0);
    }
    let (_, count) = &all["/joint2/count"][100];
    let turn = count["position_count"].as_f64().unwrap() / 655_360.0 * std::f64::consts::TAU;
    assert!((turn - at(100, "position_rad")).abs() < 1e-9);
}

#[test]
fn mcap_logs_are_compressed_and_give_the_log_back() {
    let directory = with_model();
    simulate(directory.path(), "mcap", "logs");
    simulate(directory.path(), "csv-gz", "csv");
    let [mcap, csv] = ["logs/task.mcap", "csv/task.csv.gz"].map(|name| directory.path().join(name));
    let read = Log::read(&mcap).unwrap();
    let of_csv = Log::read(&csv).unwrap();
    assert_eq!(read.len(), of_csv.len());
    for (a, b) in read.joints.iter().zip(&of_csv.joints) {
        assert!(matches!(a.position, Position::Count(_)) && a.position == b.position);
    }
    let [mcap_bytes, csv_bytes] = [mcap, csv].map(|path| std::fs::metadata(path).unwrap().len());
    // Each message has 31 bytes beside its JSON.
    let all = messages(&directory.path().join("logs/task.mcap"));
    let plain = |(_, value): &(u64, Value)| value.to_string().len() as u64 + 31;
    let plain_bytes: u64 = all.values().flatten().map(plain).sum();
    let rows = read.len();
    eprintln!("{rows} rows: {mcap_bytes} bytes, {plain_bytes} plain, {csv_bytes} of .csv.gz");
    assert!(mcap_bytes < plain_bytes / 2, "{mcap_bytes} of {plain_bytes}");
}

#[test]
fn mcap_logs_written_at_the_same_second_are_the_same() {
    let directory = with_model();
    for out in ["one", "two"] {
        simulate(directory.path(), "mcap", out);
    }
    let [one, two] = ["one", "two"]
        .map(|out| std::fs::read(directory.path().join(out).join("task.mcap")).unwrap());
    assert!(one == two);
    said(directory.path(), &["validate", "one", "--model", "model.toml", "--out", "out"]);
}
