//! npz, Parquet and rosbag2 written in memory: what is read of them, and what is refused.

use std::collections::BTreeMap;
use std::io::{Cursor, Write};
use std::path::Path;
use std::sync::Arc;

use byteorder::LittleEndian;
use files::foreign::{Stream, parse};
use files::table::{Table, Values};
use parquet::data_type::{DoubleType, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;

fn read(name: &str, bytes: Vec<u8>) -> Result<Vec<Stream>, String> {
    parse(Path::new(name), bytes, &|_| true).map_err(|error| error.to_string())
}

fn floats(table: &Table, name: &str) -> Vec<f64> {
    let values = table.get(name).unwrap_or_else(|| panic!("no {name}"));
    (0..table.rows()).map(|row| values.at(row)).collect()
}

/// A `.npy` file.
fn npy(descr: &str, order: bool, shape: &str, data: &[u8]) -> Vec<u8> {
    let order = if order { "True" } else { "False" };
    let header = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}\n");
    let length = (header.len() as u16).to_le_bytes();
    [b"\x93NUMPY\x01\x00", &length[..], header.as_bytes(), data].concat()
}

fn npz(arrays: &[(&str, Vec<u8>)]) -> Vec<u8> {
    let mut writer = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in arrays {
        let options = zip::write::SimpleFileOptions::default();
        writer.start_file(format!("{name}.npy"), options).unwrap();
        writer.write_all(bytes).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

fn bytes_of(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

#[test]
fn arrays_of_any_order_and_type() {
    let counts: Vec<u8> = [-1i32, 7, 300].iter().flat_map(|value| value.to_be_bytes()).collect();
    let single: Vec<u8> = [0.5f32, 1.5, 2.5].iter().flat_map(|value| value.to_le_bytes()).collect();
    let matrix = bytes_of(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    let file = npz(&[
        ("t", npy("<f4", false, "(3,)", &single)),
        ("count", npy(">i4", false, "(3,)", &counts)),
        ("rows", npy("<f8", false, "(3, 2)", &matrix)),
        ("columns", npy("<f8", true, "(3, 2)", &matrix)),
        ("lying", npy("<f8", false, "(2, 3)", &matrix)),
        ("name", npy("<U5", false, "()", b"")),
    ]);
    let streams = read("log.npz", file).unwrap();
    let [Stream { name, table }] = streams.as_slice() else { panic!("{streams:?}") };
    assert_eq!((name.as_str(), table.rows()), ("", 3));
    assert_eq!(floats(table, "t"), [0.5, 1.5, 2.5]);
    assert_eq!(table.get("count"), Some(&Values::Count(vec![-1, 7, 300])));
    assert_eq!(floats(table, "rows[1]"), [2.0, 4.0, 6.0]);
    assert_eq!(floats(table, "columns[1]"), [4.0, 5.0, 6.0]);
    assert_eq!(floats(table, "lying[0]"), [1.0, 2.0, 3.0]);
}

#[test]
fn arrays_of_two_lengths_are_two_streams() {
    let file = npz(&[
        ("t", npy("<f8", false, "(2,)", &bytes_of(&[0.0, 1.0]))),
        ("t_cmd", npy("<f8", false, "(3,)", &bytes_of(&[0.0, 1.0, 2.0]))),
    ]);
    let names: Vec<String> = read("log.npz", file).unwrap().into_iter().map(|s| s.name).collect();
    assert_eq!(names, ["2 rows", "3 rows"]);
}

#[test]
fn damaged_arrays_are_named() {
    let cut = npy("<f8", false, "(4,)", &bytes_of(&[0.0]));
    assert!(
        read("log.npy", cut)
            .unwrap_err()
            .contains("log.npy: the NumPy data cannot be read: it is cut short")
    );
    assert!(
        read("log.npz", b"PK\x03\x04nothing".to_vec())
            .unwrap_err()
            .contains("the npz data cannot be read")
    );
    let text = npy("<U5", false, "(1,)", &[0; 20]);
    assert!(read("log.npy", text).unwrap_err().contains("of type <U5, not numbers"));
}

/// A Parquet file with lists, a time stamp in microseconds, gaps and a text.
fn parquet_file() -> Vec<u8> {
    let schema = "message log {
        required int64 stamp (TIMESTAMP(MICROS, true));
        optional double torque;
        required group state (LIST) { repeated group list { optional double element; } }
        optional binary task (STRING);
    }";
    let schema = Arc::new(parse_message_type(schema).unwrap());
    let mut bytes = Vec::new();
    let properties = Arc::new(WriterProperties::default());
    let mut writer = SerializedFileWriter::new(&mut bytes, schema, properties).unwrap();
    for group in 0..2 {
        let mut rows = writer.next_row_group().unwrap();
        let mut column = rows.next_column().unwrap().unwrap();
        let stamps = [1000 * group, 1000 * group + 500];
        column.typed::<Int64Type>().write_batch(&stamps, None, None).unwrap();
        column.close().unwrap();
        let mut column = rows.next_column().unwrap().unwrap();
        column.typed::<DoubleType>().write_batch(&[0.25], Some(&[0, 1]), None).unwrap();
        column.close().unwrap();
        let mut column = rows.next_column().unwrap().unwrap();
        let lists = [1.0, 2.0, 3.0, 4.0];
        let (definition, repetition) = ([2, 2, 2, 2], [0, 1, 0, 1]);
        column
            .typed::<DoubleType>()
            .write_batch(&lists, Some(&definition), Some(&repetition))
            .unwrap();
        column.close().unwrap();
        let mut column = rows.next_column().unwrap().unwrap();
        column
            .typed::<parquet::data_type::ByteArrayType>()
            .write_batch(&[], Some(&[0, 0]), None)
            .unwrap();
        column.close().unwrap();
        rows.close().unwrap();
    }
    writer.close().unwrap();
    bytes
}

#[test]
fn lists_gaps_and_time_stamps() {
    let streams = read("log.parquet", parquet_file()).unwrap();
    let table = &streams[0].table;
    assert_eq!(table.get("stamp"), Some(&Values::Count(vec![0, 500_000, 1_000_000, 1_500_000])));
    let torque = floats(table, "torque");
    assert!(torque[0].is_nan() && torque[1] == 0.25 && torque[2].is_nan() && torque[3] == 0.25);
    assert_eq!(floats(table, "state[0]"), [1.0, 3.0, 1.0, 3.0]);
    assert_eq!(floats(table, "state[1]"), [2.0, 4.0, 2.0, 4.0]);
    let unwanted =
        parse(Path::new("log.parquet"), parquet_file(), &|name| name == "torque").unwrap();
    assert_eq!(unwanted[0].table.names().collect::<Vec<_>>(), ["stamp", "torque", "state", "task"]);
}

#[test]
fn a_parquet_file_that_is_cut_is_named() {
    let bytes = parquet_file();
    let cut = bytes[..bytes.len() / 2].to_vec();
    assert!(
        read("log.parquet", cut)
            .unwrap_err()
            .contains("log.parquet: the Parquet data cannot be read")
    );
}

#[test]
fn a_parquet_file_that_is_damaged_anywhere_is_read_or_refused() {
    let good = parquet_file();
    let damaged = |place: usize, byte: u8| {
        let mut bytes = good.clone();
        bytes[place] = byte;
        read("log.parquet", bytes)
    };
    let refused =
        (0..good.len()).flat_map(|place| [0x00, 0x7F, 0x80, 0xFF].map(|b| damaged(place, b)));
    let refused = refused.filter_map(Result::err).collect::<Vec<_>>();
    assert!(refused.len() > 100, "{}", refused.len());
    assert!(refused.iter().all(|message| message.starts_with("log.parquet: ")));
}

/// The CDR of a message of ROS, behind its head.
fn cdr(message: &impl serde::Serialize) -> Vec<u8> {
    let body = cdr_encoding::to_vec::<_, LittleEndian>(message).unwrap();
    [&[0, 1, 0, 0], body.as_slice()].concat()
}

type JointState = ((i32, u32, String), Vec<String>, Vec<f64>, Vec<f64>, Vec<f64>);

fn joint_state(ns: u32, names: [&str; 2], positions: [f64; 2]) -> JointState {
    let names = names.map(String::from).to_vec();
    ((1, ns, "base".into()), names, positions.to_vec(), Vec::new(), vec![0.5, 0.25])
}

/// A recording: messages by topic and type.
fn mcap_file(messages: &[(&str, &str, Vec<u8>)]) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let mut writer = mcap::Writer::new(&mut bytes).unwrap();
    for (index, (topic, schema, data)) in messages.iter().enumerate() {
        let schema = writer.add_schema(schema, "ros2msg", b"").unwrap();
        let channel = writer.add_channel(schema, topic, "cdr", &BTreeMap::new()).unwrap();
        let time = 5_000_000_000 + index as u64;
        let header = mcap::records::MessageHeader {
            channel_id: channel,
            sequence: index as u32,
            log_time: time,
            publish_time: time,
        };
        writer.write_to_known_channel(&header, data).unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    bytes.into_inner()
}

const STATE: &str = "sensor_msgs/msg/JointState";
const ARRAY: &str = "std_msgs/msg/Float64MultiArray";

#[test]
fn messages_of_ros_are_told_apart_by_joint_and_topic() {
    let no_dimensions: Vec<(String, u32, u32)> = Vec::new();
    let file = mcap_file(&[
        ("/joint_states", STATE, cdr(&joint_state(0, ["elbow", "wrist"], [1.0, 2.0]))),
        ("/commands", ARRAY, cdr(&(no_dimensions, 0u32, vec![7.0, 8.0]))),
        // Another publisher may have another order.
        ("/joint_states", STATE, cdr(&joint_state(1000, ["wrist", "elbow"], [4.0, 3.0]))),
        ("/rosout", "rcl_interfaces/msg/Log", vec![0, 1, 0, 0]),
    ]);
    let streams = read("bag.mcap", file).unwrap();
    let names: Vec<&str> = streams.iter().map(|stream| stream.name.as_str()).collect();
    assert_eq!(names, ["/commands", "/joint_states"]);
    let (commands, states) = (&streams[0].table, &streams[1].table);
    assert_eq!(floats(commands, "data[1]"), [8.0]);
    assert_eq!(floats(states, "position[elbow]"), [1.0, 3.0]);
    assert_eq!(floats(states, "position[wrist]"), [2.0, 4.0]);
    assert_eq!(floats(states, "effort[wrist]"), [0.25, 0.5]);
    assert_eq!(
        states.get("header.stamp"),
        Some(&Values::Count(vec![1_000_000_000, 1_000_001_000]))
    );
    assert_eq!(commands.get("log_time"), Some(&Values::Count(vec![5_000_000_001])));
}

#[test]
fn what_cannot_be_read_is_named_by_topic() {
    let short = mcap_file(&[("/joint_states", STATE, vec![0, 1, 0, 0, 9])]);
    let message = read("bag.mcap", short).unwrap_err();
    assert!(
        message.contains("bag.mcap: message 1 on /joint_states: (sensor_msgs/msg/JointState)"),
        "{message}"
    );
    let other = mcap_file(&[("/joint_states", STATE, vec![0, 7, 0, 0, 9])]);
    assert!(read("bag.mcap", other).unwrap_err().contains("encoding 00 07 is not plain CDR"));
    let none = mcap_file(&[("/rosout", "rcl_interfaces/msg/Log", vec![0, 1, 0, 0])]);
    assert!(
        read("bag.mcap", none)
            .unwrap_err()
            .contains("topics: /rosout (rcl_interfaces/msg/Log, cdr)")
    );
    assert!(read("log.xlsx", vec![1]).unwrap_err().contains("the name does not end in .csv"));
}

#[test]
fn a_recording_without_a_mapping_is_told_what_it_has() {
    let states = joint_state(0, ["elbow", "wrist"], [1.0, 2.0]);
    let no_dimensions: Vec<(String, u32, u32)> = Vec::new();
    let file = mcap_file(&[
        ("/commands", ARRAY, cdr(&(no_dimensions, 0u32, vec![7.0, 8.0]))),
        ("/joint_states", STATE, cdr(&states)),
    ]);
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("bag.mcap"), file).unwrap();
    let view = files::mapping::View::default();
    let error = files::Log::read_mapped(directory.path(), "bag.mcap", &view).unwrap_err();
    let message = error.to_string();
    for part in [
        "bag.mcap: the column q1_rad (or q1_count) is missing",
        "found in bag.mcap, /joint_states: header.stamp, log_time, position[elbow]",
        "found in bag.mcap, /commands (not used",
        "q2_rad = \"position[wrist]\"",
        "u1_Nm = \"effort[elbow]\"",
    ] {
        assert!(message.contains(part), "no `{part}` in: {message}");
    }
}
