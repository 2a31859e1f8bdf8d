//! Logs survive writing and reading, in every format.

use std::collections::BTreeMap;

use files::{Log, Position};
use mcap::MessageStream;

mod common;
use common::{directory, log_in_counts, log_in_radians};

fn round_trip(log: &Log, name: &str) -> Log {
    let directory = directory();
    let path = directory.path().join(name);
    log.write(&path).unwrap();
    Log::read(&path).unwrap()
}

#[test]
fn every_format_gives_the_log_back() {
    for name in ["log.csv", "log.csv.gz", "log.mcap"] {
        let log = log_in_counts(500);
        assert!(round_trip(&log, name) == log, "{name}");
        assert_eq!(round_trip(&log_in_radians(), name), log_in_radians(), "{name}");
    }
}

#[test]
fn mcap_keeps_what_decimals_do_not() {
    let mut log = log_in_radians();
    log.time_s = vec![0.1 + 0.2, 1.0 / 3.0, std::f64::consts::FRAC_1_SQRT_2];
    log.joints[0].command_v = vec![1.0 / 3.0, f64::MIN_POSITIVE, -1e300];
    assert_eq!(round_trip(&log, "log.mcap"), log);
}

#[test]
fn csv_keeps_references_to_a_nanoradian() {
    let mut log = log_in_counts(3);
    let reference_rad = vec![1.0 / 3.0, -123.456_789_012_345, 1e-9];
    log.joints[1].reference_rad = Some(reference_rad.clone());
    let read = round_trip(&log, "log.csv");
    for (a, b) in read.joints[1].reference_rad.iter().flatten().zip(reference_rad) {
        assert!((a - b).abs() < 1e-9);
    }
}

#[test]
fn csv_is_written_as_the_contract_shows_it() {
    let directory = directory();
    let path = directory.path().join("log.csv");
    log_in_counts(2).write(&path).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let expected = "t_s,q1_count,q2_count,q3_count,u1_V,u2_V,u3_V,qref1_rad,qref2_rad,qref3_rad\n\
        0.000,1000,2000,3000,-0.250000,-0.250000,-0.250000,-1.500000,-1.500000,-1.500000\n\
        0.001,999,1999,2999,-0.125000,-0.125000,-0.125000,-1.375000,-1.375000,-1.375000\n";
    assert_eq!(text, expected);
}

#[test]
fn other_columns_and_other_writers_habits_are_accepted() {
    let directory = directory();
    let path = directory.path().join("log.csv");
    let text = "\u{feff}\"t_s\", note ,\"u3_V\",q3_count,temperature_C\r\n\
        0, cold ,1.5,7,20\r\n\
        1e-3,,\"-2\", 8.0 ,nan\r\n\r\n";
    std::fs::write(&path, text).unwrap();
    let log = Log::read(&path).unwrap();
    assert_eq!(log.time_s, [0.0, 0.001]);
    let [joint] = &log.joints[..] else { panic!("one joint") };
    assert_eq!(joint.joint, 3);
    assert_eq!(joint.command_v, [1.5, -2.0]);
    assert_eq!(joint.position, Position::Count(vec![7, 8]));
    assert_eq!(joint.reference_rad, None);
}

#[test]
fn a_log_tells_its_length_period_and_positions() {
    let log = log_in_counts(100);
    assert_eq!(log.len(), 100);
    assert!((log.duration_s() - 0.099).abs() < 1e-12);
    assert!((log.sample_period_s().unwrap() - 0.001).abs() < 1e-12);
    assert!(log.needs_counts_per_rev());
    let turn = log.joint(1).unwrap().position_rad(1000.0)[0];
    assert!((turn - std::f64::consts::TAU).abs() < 1e-12);
    assert_eq!(log_in_radians().joint(3).unwrap().position_rad(f64::NAN)[1], 0.25);
    assert!(log_in_radians().joint(1).is_none());
    assert_eq!(Log::default().sample_period_s(), None);
}

#[test]
fn mcap_has_a_described_channel_per_joint() {
    let directory = directory();
    let path = directory.path().join("log.mcap");
    let log = log_in_counts(2500);
    log.write(&path).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    let mut times_ns: BTreeMap<String, Vec<u64>> = BTreeMap::new();
    for message in MessageStream::new(&bytes).unwrap() {
        let message = message.unwrap();
        assert_eq!(message.log_time, message.publish_time);
        assert_eq!(message.channel.message_encoding, "json");
        let schema = message.channel.schema.as_ref().unwrap();
        assert_eq!(schema.encoding, "jsonschema");
        times_ns.entry(message.channel.topic.clone()).or_default().push(message.log_time);
    }
    let expected: Vec<u64> = (0..2500).map(|row| row * 1_000_000).collect();
    assert_eq!(times_ns.keys().collect::<Vec<_>>(), ["/joint1", "/joint2", "/joint3"]);
    assert!(times_ns.values().all(|times| *times == expected));
    let summary = mcap::Summary::read(&bytes).unwrap().unwrap();
    assert_eq!((summary.channels.len(), summary.schemas.len()), (3, 3));
    assert_eq!(summary.stats.unwrap().message_count, 7500);
}

#[test]
fn mcap_schemas_name_the_fields_that_messages_have() {
    let directory = directory();
    for (log, name) in [(log_in_counts(1), "counts.mcap"), (log_in_radians(), "radians.mcap")] {
        let path = directory.path().join(name);
        log.write(&path).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        for message in MessageStream::new(&bytes).unwrap() {
            let message = message.unwrap();
            let schema = &message.channel.schema.as_ref().unwrap().data;
            let schema: serde_json::Value = serde_json::from_slice(schema).unwrap();
            let sample: serde_json::Value = serde_json::from_slice(&message.data).unwrap();
            let of = |value: &serde_json::Value| -> Vec<String> {
                value.as_object().unwrap().keys().cloned().collect()
            };
            assert_eq!(schema["type"], "object");
            assert_eq!(of(&schema["properties"]), of(&sample));
        }
    }
}

#[test]
fn measured_logs_survive_all_formats() {
    let logs = ["rig-1/task.csv.gz", "dfki-pendulum/identification.csv.gz"];
    for path in logs.into_iter().filter_map(test_support::data) {
        let log = Log::read(path).unwrap();
        assert!(round_trip(&log, "log.mcap") == log);
        let read = round_trip(&log, "log.csv.gz");
        assert!(read.time_s == log.time_s);
        for (a, b) in read.joints.iter().zip(&log.joints) {
            assert!(a.position == b.position && a.reference_rad == b.reference_rad);
            let close = |(a, b): (&f64, &f64)| (a - b).abs() <= 5.1e-7;
            assert!(a.command_v.iter().zip(&b.command_v).all(close));
        }
    }
}
