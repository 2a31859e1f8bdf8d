//! What a run records.

use std::path::Path;

use assert_cmd::Command;
use files::{Dataset, Log, Role};
use simulation::simulated_board::{BoardSettings, SimulatedBoard};

use crate::{assert_tells, board, rrr, settings, stdout, with_model};

/// The figures of the line that begins so.
pub fn figures<const N: usize>(text: &str, line: &str) -> [usize; N] {
    let line = text.lines().find(|found| found.starts_with(line)).expect(line);
    let numbers = line.split(|letter: char| !letter.is_ascii_digit());
    let numbers: Vec<usize> = numbers.filter_map(|number| number.parse().ok()).collect();
    numbers.try_into().expect(line)
}

/// Rows, ticks and missing records as messages, of a log of that many rows.
pub fn assert_all_ticks_are_accounted_for(text: &str, log: &Log) -> [usize; 3] {
    let [rows, ticks, missing, dropped] = figures(text, "samples");
    assert_eq!(rows, log.len(), "{text}");
    assert_eq!(rows + missing, ticks, "{text}");
    assert!(dropped <= missing, "{text}");
    [rows, ticks, missing]
}

/// The board's messages in an MCAP file.
pub fn board_messages(path: &Path) -> Vec<serde_json::Value> {
    let bytes = std::fs::read(path).unwrap();
    let messages = mcap::MessageStream::new(&bytes).unwrap().map(Result::unwrap);
    let of_board = messages.filter(|message| message.channel.topic == "/board");
    of_board.map(|message| serde_json::from_slice(&message.data).unwrap()).collect()
}

#[test]
fn a_run_is_recorded_as_a_data_set_that_grows() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    let text =
        stdout(rrr(at, &board, "run task --duration 6 --out logs --approach-speed 3").success());
    assert_tells(&text, &["of 6000", "played to its end; 0 V, disarmed"]);
    rrr(at, &board, "run slow --duration 2 --out logs --role train --approach-speed 3").success();
    rrr(at, &board, "run slow --duration 2 --out logs --approach-speed 3").success();

    let dataset = Dataset::read(at.join("logs")).unwrap();
    let entries: Vec<_> = dataset.entries.iter().map(|e| (e.file.as_str(), e.role)).collect();
    let expected = ["task.csv.gz", "slow.csv.gz", "slow-2.csv.gz"];
    let roles = [Role::Holdout, Role::Train, Role::Train];
    assert_eq!(entries, std::iter::zip(expected, roles).collect::<Vec<_>>());
    let recordings = dataset.recordings().unwrap();
    let mcap = Log::read(at.join("logs/task.mcap")).unwrap();
    assert_eq!(recordings[0].log.time_s, mcap.time_s);
    for (csv, mcap) in recordings[0].log.joints.iter().zip(&mcap.joints) {
        assert_eq!(csv.position, mcap.position);
    }
    let messages = board_messages(&at.join("logs/task.mcap"));
    assert_eq!(messages.len(), mcap.len(), "the board's own channel");
    assert!(
        messages
            .iter()
            .all(|messages| messages["state"] == "running" && messages["fault"] == "none")
    );
    assert_all_ticks_are_accounted_for(&text, &mcap);
    assert!(recordings[0].log.len() > 5900, "{}", recordings[0].log.len());
    // The arm followed: 0.01 rad is far more than the model leaves, far less than none.
    let joint = recordings[0].log.joint(1).unwrap();
    let reference = joint.reference_rad.as_ref().unwrap();
    let q = joint.position_rad(655_360.0);
    let error = q.iter().zip(reference).map(|(q, r)| (q - r).abs()).fold(0.0, f64::max);
    assert!(error < 0.01, "{error} rad");
    assert!(reference.iter().fold(0.0f64, |most, r| most.max(*r)) > 3.0);

    let mut validate = Command::cargo_bin("rrr").unwrap();
    validate.current_dir(at).args("validate logs --model model.toml --out page".split(' '));
    assert_tells(&stdout(validate.assert().success()), &["task"]);
}

#[test]
fn a_list_that_is_there_stays_as_it_was_and_gets_one_log_more() {
    let (directory, board) = (with_model(), board());
    let at = directory.path();
    rrr(at, &board, "upload model.toml").success();
    std::fs::create_dir(at.join("logs")).unwrap();
    let list = at.join("logs/dataset.toml");
    let there = "# Rig 3\nformat = 1\nencoder_counts_per_rev = 655360\nnote = \"left\"\n\n[[log]]\n\
        file = \"a.csv\"  # by hand\nexperiment = \"belt-test\"\nrole = \"train\"\n";
    std::fs::write(&list, there).unwrap();
    rrr(at, &board, "run hold --duration 1 --out logs").success();
    let added = "\n[[log]]\nfile = \"hold.csv.gz\"\nexperiment = \"task\"\nrole = \"holdout\"\n";
    assert_eq!(std::fs::read_to_string(&list).unwrap(), format!("{there}{added}"));
}

#[test]
fn a_noisy_line_costs_time_and_records_each_counted_and_nothing_else() {
    let directory = with_model();
    let at = directory.path();
    let noisy = BoardSettings { bytes_per_error: Some(1000), speed: 1.0, ..settings() };
    let board = SimulatedBoard::start(noisy).unwrap();
    rrr(at, &board, "upload model.toml").success();
    let text = stdout(rrr(at, &board, "run hold --duration 5 --out logs").success());
    assert_tells(&text, &["played to its end"]);
    let log = Log::read(at.join("logs/hold.csv.gz")).unwrap();
    // 67 bytes a record: some 6 in 100 are broken.
    assert!((4000..5000).contains(&log.len()), "{}", log.len());
    let [rows, ticks, missing] = assert_all_ticks_are_accounted_for(&text, &log);
    assert_eq!((ticks, missing), (5000, 5000 - rows));
    let [broken, _asked_again] = figures(&text, "line");
    assert!(broken > 100, "{text}");
}
