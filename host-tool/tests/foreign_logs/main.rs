//! The same logs as CSV, npz, Parquet and rosbag2: `rrr import` maps them, `rrr diagnose` says the same.

use std::path::Path;
use std::process::Command;

use assert_cmd::cargo::cargo_bin;
use serde_json::Value;
use test_support::{PIVOT, Python};

/// The libraries that others write their logs with.
const WITH_LOG_WRITERS: Python = Python {
    variable: "RRR_LOGS_PYTHON",
    folder: "logs-python",
    packages: &["mcap-ros2-support==0.6.0", "numpy", "pyarrow"],
    imports: "mcap_ros2, numpy, pyarrow",
};

/// Runs `rrr` and returns what it printed.
fn rrr(arguments: &[&str]) -> String {
    let run = Command::new(cargo_bin("rrr")).args(arguments).output().unwrap();
    let error = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "rrr {arguments:?}: {error}");
    String::from_utf8(run.stdout).unwrap()
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// The logs of a pendulum whose cogging the model does not have, and the model.
fn simulated(at: &Path) -> Vec<String> {
    std::fs::write(at.join("model.toml"), PIVOT).unwrap();
    let effect = "cogging:1:amplitude_V=0.15,harmonic=7,phase_rad=0.4";
    let (model, csv) = (at.join("model.toml"), at.join("csv"));
    let out = ["--dataset", "gap", "--out", text(&csv), "--effect", effect];
    rrr(&[&["simulate", "--model", text(&model)], &out[..]].concat());
    let list = std::fs::read_to_string(csv.join("dataset.toml")).unwrap();
    list.lines()
        .filter_map(|line| line.strip_prefix("file = "))
        .map(|name| name.replace('"', ""))
        .collect()
}

/// The report of a diagnosis, the ending of files' names left away.
fn report(at: &Path, set: &str) -> Value {
    let (model, logs, out) = (at.join("model.toml"), at.join(set), at.join(format!("out-{set}")));
    rrr(&["diagnose", text(&logs), "--model", text(&model), "--out", text(&out)]);
    let report = std::fs::read_to_string(out.join("report.json")).unwrap();
    serde_json::from_str(&report.replace(&format!(".{set}"), "")).unwrap()
}

/// Puts the files of an ending into a folder of their own, and has them imported with the roles that
/// the list of the CSV logs has.
fn imported(at: &Path, ending: &str, names: &[String]) -> String {
    let folder = at.join(ending);
    std::fs::create_dir_all(&folder).unwrap();
    for name in names {
        let name = name.replace(".csv", &format!(".{ending}"));
        std::fs::rename(at.join("csv").join(&name), folder.join(&name)).unwrap();
    }
    let model = at.join("model.toml");
    let said = rrr(&["import", text(&folder), "--model", text(&model)]);
    let list = folder.join("dataset.toml");
    let written = std::fs::read_to_string(&list).unwrap();
    let (mapping, _) = written.split_once("\n[[log]]").unwrap();
    let logs = std::fs::read_to_string(at.join("csv/dataset.toml")).unwrap();
    let (_, logs) = logs.split_once("[[log]]").unwrap();
    let logs = logs.replace(".csv", &format!(".{ending}"));
    std::fs::write(&list, format!("{mapping}\n[[log]]{logs}")).unwrap();
    said
}

#[test]
fn the_same_logs_in_four_formats_give_the_same_report() {
    let Some(python) = WITH_LOG_WRITERS.find(env!("CARGO_TARGET_TMPDIR")) else { return };
    let directory = tempfile::tempdir().unwrap();
    let at = directory.path();
    let names = simulated(at);
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/foreign_logs/write_logs.py");
    for name in &names {
        let csv = at.join("csv");
        let run =
            Command::new(&python).arg(&script).args([&csv.join(name), &csv]).output().unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    }
    let of_csv = report(at, "csv");
    assert_eq!(of_csv["causes"][0]["effect"], "cogging");
    for ending in ["npz", "parquet", "mcap"] {
        let said = imported(at, ending, &names);
        assert!(said.contains("u1_Nm = "), "{said}");
        assert_eq!(report(at, ending), of_csv, "{ending}: {said}");
    }
}

#[test]
fn a_list_that_is_there_stays_unless_it_is_forced() {
    let directory = tempfile::tempdir().unwrap();
    let log = "time_ms,pos_1_deg,torque_cmd_1\n0,10,0.1\n2,200,0.2\n4,30,0.1\n";
    std::fs::write(directory.path().join("run.csv"), log).unwrap();
    let path = text(directory.path());
    let said = rrr(&["import", path]);
    for part in [
        "t_s = { column = \"time_ms\", unit = \"ms\" }    # \"ms\" in its name",
        "q1_rad = { column = \"pos_1_deg\", unit = \"deg\" }",
        "u1_Nm = \"torque_cmd_1\"",
        "3 rows in 0.00 s, 500.0 Hz",
    ] {
        assert!(said.contains(part), "no `{part}` in: {said}");
    }
    let again = Command::new(cargo_bin("rrr")).args(["import", path]).output().unwrap();
    assert_eq!(again.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&again.stderr).contains("dataset.toml is there already"));
    rrr(&["import", path, "--force"]);
}
