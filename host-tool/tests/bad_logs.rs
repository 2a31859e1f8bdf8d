//! Whatever is wrong with a log is named: file, line, column, value, and the cure.

use std::io::Write;

use files::{FileError, JointLog, Log, Position};

mod common;
use common::{directory, log_in_counts, log_in_radians};

const HEADER: &str = "t_s,q3_count,u3_V\n";

/// The error of a file of the given bytes.
fn error_of(name: &str, bytes: &[u8]) -> FileError {
    let directory = directory();
    let path = directory.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    Log::read(&path).unwrap_err()
}

/// Asserts that a CSV text is refused with a message that has all the parts.
fn assert_says(text: impl AsRef<[u8]>, parts: &[&str]) {
    let error = error_of("bad.csv", text.as_ref());
    let message = error.to_string();
    for part in [&["bad.csv"], parts].concat() {
        assert!(message.contains(part), "no `{part}` in: {message}");
    }
    assert!(!error.hint().is_empty());
}

/// The same with the usual header before the lines.
fn assert_lines_say(lines: &str, parts: &[&str]) {
    assert_says(HEADER.to_owned() + lines, parts);
}

#[test]
fn missing_file() {
    let error = Log::read("no/such/log.csv").unwrap_err();
    assert_eq!(error.to_string(), "no/such/log.csv: there is no such file");
}

#[test]
fn a_directory_is_not_a_log() {
    let directory = directory();
    let path = directory.path().join("log.csv");
    std::fs::create_dir(&path).unwrap();
    assert!(Log::read(&path).unwrap_err().to_string().contains("cannot be read"));
}

#[test]
fn unknown_extension() {
    let error = error_of("log.txt", b"");
    assert!(error.to_string().contains("log.txt: the name does not end in .csv"));
    assert!(log_in_radians().write("log.txt").is_err());
}

#[test]
fn empty_files() {
    assert_says("", &["is empty"]);
    assert_says("\n \n", &["is empty"]);
    assert_lines_say("", &["no samples"]);
    assert_lines_say("\r\n\n", &["no samples"]);
    assert!(error_of("bad.mcap", b"").to_string().contains("is empty"));
    assert!(error_of("bad.csv.gz", b"").to_string().contains("is empty"));
}

#[test]
fn missing_columns() {
    assert_says("q3_count,u3_V\n0,0\n", &["column t_s is missing"]);
    assert_says("t_s,q3_count\n0,0\n", &["column u3_V is missing"]);
    assert_says("t_s,u2_V\n0,0\n", &["column q2_count (or q2_rad) is missing"]);
    assert_says("t_s,speed\n0,0\n", &["no joint"]);
}

#[test]
fn columns_that_contradict() {
    assert_says("t_s,q3_rad,u3_V,u3_V\n0,0,0,0\n", &["line 1", "column u3_V", "twice"]);
    let both = "t_s,q3_count,q3_rad,u3_V\n0,0,0,0\n";
    assert_says(both, &["joint 3", "both in counts and in radians"]);
}

#[test]
fn broken_lines() {
    let count = ["line 3", "has 2 fields", "header has 3"];
    assert_lines_say("0,1,2\n0.001,5\n0.002,1,2\n", &count);
    assert_lines_say("0,1,2\n0.001,5", &count);
    assert_lines_say("0,1,2\n0.1,5,6,7\n", &["line 3", "has 4 fields", "header has 3"]);
    assert_lines_say("0,1,2\n\n0.1,5,6\n", &["line 3", "has 1 fields"]);
}

#[test]
fn fields_that_are_no_numbers() {
    assert_lines_say("0,1,2\n0.1,5,six\n", &["line 3", "column u3_V", "`six` is not a number"]);
    assert_lines_say("0,1,\n", &["line 2", "column u3_V", "`` is not a number"]);
    assert_lines_say("0,x,1\n", &["line 2", "column q3_count", "`x` is not a number"]);
    assert_lines_say("0,1,2\n0.1,5,1.5.2\n", &["line 3", "column u3_V", "`1.5.2`"]);
    assert_lines_say("0:00,1,2\n", &["line 2", "column t_s", "`0:00` is not a number"]);
}

#[test]
fn numbers_that_are_not_finite() {
    assert_lines_say("0,1,nan\n", &["line 2", "column u3_V", "`nan` is not a finite number"]);
    assert_lines_say("0,1,2\n-inf,1,2\n", &["line 3", "column t_s", "`-inf` is not a finite"]);
    assert_lines_say("0,1,1e999\n", &["line 2", "column u3_V", "`1e999` is not a finite"]);
}

#[test]
fn counts_that_are_not_whole() {
    let parts = ["line 3", "column q3_count", "`12.5` is not a whole number"];
    assert_lines_say("0,1,2\n0.1,12.5,0\n", &parts);
}

#[test]
fn time_that_does_not_increase() {
    let parts = ["line 4", "column t_s", "time goes from 0.001 s to 0.001 s"];
    assert_lines_say("0,1,2\n0.001,1,2\n0.001,1,2\n", &parts);
    assert_lines_say("0,1,2\n-1,1,2\n", &["line 3", "time goes from 0 s to -1 s"]);
}

#[test]
fn bytes_that_are_no_text() {
    let bytes = [HEADER.as_bytes(), b"0,1,2\n0.1,\xff,2\n"].concat();
    assert_says(bytes, &["line 3", "byte 0xff is not UTF-8"]);
}

#[test]
fn gzip_that_is_cut_short_or_damaged() {
    let directory = directory();
    let path = directory.path().join("log.csv.gz");
    log_in_counts(200).write(&path).unwrap();
    let whole = std::fs::read(&path).unwrap();
    for length in [1, 9, 20, whole.len() / 2, whole.len() - 1] {
        let message = error_of("bad.csv.gz", &whole[..length]).to_string();
        assert!(message.contains("bad.csv.gz: the gzip data is cut short or damaged"), "{message}");
    }
    assert!(error_of("bad.csv.gz", b"t_s,q3_count").to_string().contains("gzip"));
}

#[test]
fn mcap_that_is_cut_short_or_damaged() {
    let directory = directory();
    let path = directory.path().join("log.mcap");
    log_in_counts(200).write(&path).unwrap();
    let whole = std::fs::read(&path).unwrap();
    for length in [1, 100, whole.len() / 2] {
        let message = error_of("bad.mcap", &whole[..length]).to_string();
        assert!(message.contains("bad.mcap: the MCAP data is cut short or damaged"), "{message}");
    }
}

/// An MCAP file of one channel with the given messages.
fn mcap_of(topic: &str, messages: &[&str]) -> Vec<u8> {
    let mut writer = mcap::Writer::new(std::io::Cursor::new(Vec::new())).unwrap();
    let channel = writer.add_channel(0, topic, "json", &Default::default()).unwrap();
    for (time, message) in (0..).zip(messages) {
        let header = mcap::records::MessageHeader {
            channel_id: channel,
            sequence: 0,
            log_time: time * 1_000_000,
            publish_time: 0,
        };
        writer.write_to_known_channel(&header, message.as_bytes()).unwrap();
    }
    writer.finish().unwrap();
    writer.into_inner().into_inner()
}

#[test]
fn mcap_messages_that_are_no_samples() {
    let good = r#"{"position_count": 1, "command_V": 0}"#;
    let says = |messages: &[&str], part: &str| {
        let message = error_of("bad.mcap", &mcap_of("/joint2", messages)).to_string();
        assert!(message.contains(part), "no `{part}` in: {message}");
    };
    says(&[good, "{}"], "message 2 on /joint2: missing field `command_V`");
    says(&[good, "not JSON"], "message 2 on /joint2");
    says(&[good, r#"{"command_V": 0}"#], "column q2_count: 1 samples, but 2 times");
    says(&[good, r#"{"position_rad": 1, "command_V": 0}"#], "both in counts and in radians");
    says(&[r#"{"t_s": 1, "position_rad": 1, "command_V": 0}"#; 2], "time goes from 1 s to 1 s");
    let other = error_of("bad.mcap", &mcap_of("/camera", &["{}"])).to_string();
    assert!(other.contains("no joint"), "{other}");
}

#[test]
fn mcap_of_other_writers_takes_its_time_from_the_messages() {
    let directory = directory();
    let path = directory.path().join("log.mcap");
    let sample = r#"{"position_rad": 0.5, "command_V": 0, "temperature": 20}"#;
    std::fs::write(&path, mcap_of("/joint1", &[sample, sample])).unwrap();
    assert_eq!(Log::read(&path).unwrap().time_s, [0.0, 0.001]);
}

#[test]
fn a_log_that_would_not_read_back_is_not_written() {
    let directory = directory();
    let path = directory.path().join("log.csv.gz");
    let says = |log: &Log, part: &str| {
        let message = log.write(&path).unwrap_err().to_string();
        assert!(message.contains(part), "no `{part}` in: {message}");
        assert!(!path.exists());
    };
    says(&Log::default(), "no joint");
    says(&Log { time_s: vec![], ..log_in_radians() }, "no samples");
    says(&Log { time_s: vec![0.0], ..log_in_radians() }, "column q3_rad: 3 samples, but 1 times");
    says(&Log { time_s: vec![0.0, 1.0, 1.0], ..log_in_radians() }, "line 4, column t_s");
    let with = |change: fn(&mut JointLog)| {
        let mut log = log_in_radians();
        change(&mut log.joints[0]);
        log
    };
    says(&with(|joint| joint.command_v[1] = f64::NAN), "line 3, column u3_V");
    says(&with(|joint| joint.position = Position::Radian(vec![f64::INFINITY; 3])), "q3_rad");
    says(&with(|joint| joint.reference_rad = Some(vec![])), "column qref3_rad: 0 samples");
    says(&with(|joint| joint.joint = 4), "joint 4 is not 1, 2 or 3");
}

#[test]
fn times_closer_than_the_decimals_tell_are_not_written() {
    let directory = directory();
    let path = directory.path().join("log.csv");
    let log = Log { time_s: vec![0.0, 1.0, 1.0 + 1e-10], ..log_in_radians() };
    let message = log.write(&path).unwrap_err().to_string();
    assert!(message.contains("line 4, column t_s"), "{message}");
}

#[test]
fn times_below_zero_do_not_fit_mcap() {
    let directory = directory();
    let log = Log { time_s: vec![-1.0, 0.0, 1.0], ..log_in_radians() };
    let message = log.write(directory.path().join("log.mcap")).unwrap_err().to_string();
    assert!(message.contains("column t_s: time -1 s cannot be stored"), "{message}");
}

#[test]
fn a_failed_write_leaves_what_was_there() {
    let directory = directory();
    let path = directory.path().join("log.csv");
    std::fs::File::create(&path).unwrap().write_all(b"before").unwrap();
    assert!(Log::default().write(&path).is_err());
    assert_eq!(std::fs::read(&path).unwrap(), b"before");
    let nowhere = directory.path().join("none").join("log.csv");
    let message = log_in_radians().write(&nowhere).unwrap_err().to_string();
    assert!(message.contains("cannot be written"), "{message}");
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 1);
}

/// Found by fuzzing: a metadata record whose text claims to be 3 GB long, which is not looked at.
#[test]
fn mcap_that_claims_memory() {
    let bytes = b"\x89MCAP0\r\n\x0c\x0a\0\0\0\0\0\0\0\0\x7a\0\xff\xba%M\0\x89MC\0";
    let message = error_of("bad.mcap", bytes).to_string();
    assert!(message.contains("bad.mcap: the MCAP data is cut short or damaged"), "{message}");
}

/// Found by fuzzing: a record that is longer than the chunk around it.
#[test]
fn mcap_whose_record_outgrows_its_chunk() {
    let chunk = [&[0; 28][..], &[0; 4], &9_u64.to_le_bytes(), &[5], &4_u64.to_le_bytes()].concat();
    for length in [chunk.len() as u64, 1 << 26] {
        let length = length.to_le_bytes();
        let bytes = [&b"\x89MCAP0\r\n\x06"[..], &length, &chunk, &[0; 64]].concat();
        let message = error_of("bad.mcap", &bytes).to_string();
        assert!(message.contains("bad.mcap: the MCAP data is cut short or damaged"), "{message}");
    }
}
