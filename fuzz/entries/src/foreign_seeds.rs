//! Good files of others' formats, from which damage begins.

use std::collections::BTreeMap;
use std::io::{Cursor, Write};
use std::sync::Arc;

use byteorder::LittleEndian;
use parquet::basic::Compression;
use parquet::data_type::{DoubleType, FloatType, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::parser::parse_message_type;

/// Text with semicolons, units and no header.
pub fn texts() -> Vec<Vec<u8>> {
    let texts = [
        "Zeit;Winkel 1;Moment\ns;deg;Nm\n0,001;12,5;-1e-3\n0,002;;2\n",
        "# rig 3\n# t\tq1\tu1\n1700000000000000001\t0.5\t1\n1700000000000000002\t\"0.6\"\t2\n",
        "t_s,q1_rad,u1_V\n0,1,2\n0.5,2,3\n",
        "0,1\n1,2\n",
    ];
    texts.map(|text| text.as_bytes().to_vec()).to_vec()
}

fn npy(descr: &str, order: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}\n");
    let length = (header.len() as u16).to_le_bytes();
    [b"\x93NUMPY\x01\x00", &length[..], header.as_bytes(), data].concat()
}

fn archive(method: zip::CompressionMethod) -> Vec<u8> {
    let numbers: Vec<u8> = (0..12).flat_map(|k| f64::from(k).to_le_bytes()).collect();
    let arrays = [
        ("t_s", npy("<f8", "False", "(4,)", &numbers[..32])),
        ("q", npy("<f8", "True", "(4, 3)", &numbers)),
        ("u", npy(">i2", "False", "(2, 4)", &numbers[..16])),
    ];
    let mut writer = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in arrays {
        let options = zip::write::SimpleFileOptions::default().compression_method(method);
        writer.start_file(format!("{name}.npy"), options).expect("a file in memory");
        writer.write_all(&bytes).expect("memory");
    }
    writer.finish().expect("memory").into_inner()
}

/// NumPy's archives, packed and not.
pub fn archives() -> Vec<Vec<u8>> {
    vec![archive(zip::CompressionMethod::Stored), archive(zip::CompressionMethod::Deflated)]
}

const SCHEMA: &str = "message log {
    required int64 stamp (TIMESTAMP(MICROS, true));
    optional double torque;
    required group state (LIST) { repeated group list { optional float element; } }
}";

fn parquet_file(compression: Compression) -> Result<Vec<u8>, parquet::errors::ParquetError> {
    let schema = Arc::new(parse_message_type(SCHEMA)?);
    let properties = WriterProperties::builder().set_compression(compression).build();
    let mut bytes = Vec::new();
    let mut writer = SerializedFileWriter::new(&mut bytes, schema, Arc::new(properties))?;
    let mut rows = writer.next_row_group()?;
    if let Some(mut column) = rows.next_column()? {
        column.typed::<Int64Type>().write_batch(&[1000, 2000, 3000], None, None)?;
        column.close()?;
    }
    if let Some(mut column) = rows.next_column()? {
        column.typed::<DoubleType>().write_batch(&[0.5, 1.5], Some(&[1, 0, 1]), None)?;
        column.close()?;
    }
    if let Some(mut column) = rows.next_column()? {
        let (values, definition) = ([1.0, 2.0, 3.0, 4.0, 5.0], [2, 2, 2, 1, 2, 2]);
        let repetition = [0, 1, 0, 1, 0, 1];
        column.typed::<FloatType>().write_batch(&values, Some(&definition), Some(&repetition))?;
        column.close()?;
    }
    rows.close()?;
    writer.close()?;
    Ok(bytes)
}

/// Parquet files, packed in several ways.
pub fn parquets() -> Vec<Vec<u8>> {
    let ways =
        [Compression::UNCOMPRESSED, Compression::SNAPPY, Compression::ZSTD(Default::default())];
    ways.map(|way| parquet_file(way).expect("the schema is good")).to_vec()
}

fn cdr(message: &impl serde::Serialize) -> Vec<u8> {
    let body = cdr_encoding::to_vec::<_, LittleEndian>(message).expect("plain numbers");
    [&[0, 1, 0, 0], body.as_slice()].concat()
}

/// Recordings of ROS; most are not packed, so that damage reaches the messages.
pub fn recordings() -> Vec<Vec<u8>> {
    let header = || (1, 5u32, "base".to_owned());
    let names = || vec!["elbow".to_owned(), "wrist".to_owned()];
    let (two, none) = (vec![1.0, 2.0], Vec::<f64>::new());
    let dimensions = vec![("d".to_owned(), 2u32, 2u32)];
    let point = (two.clone(), none.clone(), none.clone(), two.clone(), 0i32, 7u32);
    let interfaces = vec![(vec!["position".to_owned()], vec![0.5]); 2];
    let messages = [
        ("sensor_msgs/msg/JointState", cdr(&(header(), names(), &two, &none, &two))),
        ("std_msgs/msg/Float64MultiArray", cdr(&(dimensions, 0u32, &two))),
        ("std_msgs/msg/Float64", cdr(&1.5f64)),
        ("trajectory_msgs/msg/JointTrajectory", cdr(&(header(), names(), vec![point]))),
        ("control_msgs/msg/DynamicJointState", cdr(&(header(), names(), interfaces))),
    ];
    let packings = [None, Some(mcap::Compression::Zstd), Some(mcap::Compression::Lz4)];
    let all = packings.map(|packing| recording(&messages, packing));
    let single = messages.iter().map(|message| recording(std::slice::from_ref(message), None));
    all.into_iter().chain(single).map(|recording| recording.expect("memory")).collect()
}

fn recording(
    messages: &[(&str, Vec<u8>)],
    packing: Option<mcap::Compression>,
) -> mcap::McapResult<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    let options = mcap::WriteOptions::new().compression(packing).calculate_chunk_crcs(false);
    let mut writer = options.create(&mut bytes)?;
    for (index, (schema, data)) in (0..).zip(messages) {
        let id = writer.add_schema(schema, "ros2msg", b"")?;
        let channel_id = writer.add_channel(id, &format!("/{schema}"), "cdr", &BTreeMap::new())?;
        let time = 7_000 + u64::from(index);
        let (log_time, publish_time, sequence) = (time, time, index);
        let header = mcap::records::MessageHeader { channel_id, sequence, log_time, publish_time };
        writer.write_to_known_channel(&header, data)?;
    }
    writer.finish()?;
    drop(writer);
    Ok(bytes.into_inner())
}
