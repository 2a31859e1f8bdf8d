//! The messages of ROS 2 that are read, decoded from CDR, as named numbers.

use byteorder::{BigEndian, LittleEndian};
use cdr_encoding::from_bytes;
use serde::Deserialize;

/// Whether messages of a type are read.
pub(super) fn is_known(schema: &str) -> bool {
    DECODERS.iter().any(|(name, _)| *name == schema)
}

/// What was decoded of a message.
#[derive(Debug, Default)]
pub(super) struct Decoded {
    /// Time in its header [ns].
    pub(super) stamp_ns: Option<i64>,
    /// Numbers by name.
    pub(super) values: Vec<(String, f64)>,
}

/// Decodes a message of a type in CDR, its encapsulation first.
pub(super) fn decode(schema: &str, data: &[u8]) -> Result<Decoded, String> {
    let unknown = || format!("messages of type {schema} are not read");
    let (_, decode) = DECODERS.iter().find(|(name, _)| *name == schema).ok_or_else(unknown)?;
    decode(data)
}

type Decoder = fn(&[u8]) -> Result<Decoded, String>;

const DECODERS: [(&str, Decoder); 6] = [
    ("sensor_msgs/msg/JointState", |data| cdr::<JointState>(data).map(JointState::decoded)),
    ("std_msgs/msg/Float64MultiArray", |data| cdr::<Array<f64>>(data).map(|m| m.decoded())),
    ("std_msgs/msg/Float32MultiArray", |data| cdr::<Array<f32>>(data).map(|m| m.decoded())),
    ("std_msgs/msg/Float64", |data| cdr::<f64>(data).map(single)),
    ("trajectory_msgs/msg/JointTrajectory", |data| {
        cdr::<Trajectory>(data).map(Trajectory::decoded)
    }),
    ("control_msgs/msg/DynamicJointState", |data| {
        cdr::<DynamicState>(data).map(DynamicState::decoded)
    }),
];

#[derive(Debug, Deserialize)]
struct Header {
    sec: i32,
    nanosec: u32,
    _frame_id: String,
}

impl Header {
    fn stamp_ns(&self) -> Option<i64> {
        Some(i64::from(self.sec) * 1_000_000_000 + i64::from(self.nanosec))
    }
}

#[derive(Debug, Deserialize)]
struct JointState {
    header: Header,
    name: Vec<String>,
    position: Vec<f64>,
    velocity: Vec<f64>,
    effort: Vec<f64>,
}

impl JointState {
    fn decoded(self) -> Decoded {
        let Self { header, name, position, velocity, effort } = self;
        let kinds = [("position", position), ("velocity", velocity), ("effort", effort)];
        Decoded { stamp_ns: header.stamp_ns(), values: of_joints(&name, &kinds) }
    }
}

/// Numbers of several kinds, each by joint.
fn of_joints(names: &[String], kinds: &[(&str, Vec<f64>)]) -> Vec<(String, f64)> {
    let of_kind = |(kind, values): &(&str, Vec<f64>)| -> Vec<(String, f64)> {
        let named = names.iter().zip(values);
        named.map(|(name, value)| (format!("{kind}[{name}]"), *value)).collect()
    };
    kinds.iter().flat_map(of_kind).collect()
}

#[derive(Debug, Deserialize)]
struct Dimension {
    _label: String,
    _size: u32,
    _stride: u32,
}

#[derive(Debug, Deserialize)]
struct Array<T> {
    _dimensions: Vec<Dimension>,
    data_offset: u32,
    data: Vec<T>,
}

impl<T: Copy + Into<f64>> Array<T> {
    fn decoded(&self) -> Decoded {
        let data = self.data.iter().skip(self.data_offset as usize);
        let named =
            data.enumerate().map(|(index, &value)| (format!("data[{index}]"), value.into()));
        Decoded { stamp_ns: None, values: named.collect() }
    }
}

fn single(value: f64) -> Decoded {
    Decoded { stamp_ns: None, values: vec![("data".to_owned(), value)] }
}

#[derive(Debug, Deserialize)]
struct Trajectory {
    header: Header,
    joint_names: Vec<String>,
    points: Vec<Point>,
}

#[derive(Debug, Deserialize)]
struct Point {
    positions: Vec<f64>,
    velocities: Vec<f64>,
    _accelerations: Vec<f64>,
    effort: Vec<f64>,
    _sec: i32,
    _nanosec: u32,
}

impl Trajectory {
    /// The first point: where commands are streamed it is the only one.
    fn decoded(self) -> Decoded {
        let stamp_ns = self.header.stamp_ns();
        let values = self.points.into_iter().next().map(|point| {
            let Point { positions, velocities, effort, .. } = point;
            let kinds = [("positions", positions), ("velocities", velocities), ("effort", effort)];
            of_joints(&self.joint_names, &kinds)
        });
        Decoded { stamp_ns, values: values.unwrap_or_default() }
    }
}

#[derive(Debug, Deserialize)]
struct DynamicState {
    header: Header,
    joint_names: Vec<String>,
    interfaces: Vec<Interfaces>,
}

#[derive(Debug, Deserialize)]
struct Interfaces {
    names: Vec<String>,
    values: Vec<f64>,
}

impl DynamicState {
    fn decoded(self) -> Decoded {
        let joints = self.joint_names.iter().zip(&self.interfaces);
        let of_joint = |(joint, interfaces): (&String, &Interfaces)| -> Vec<(String, f64)> {
            let named = interfaces.names.iter().zip(&interfaces.values);
            named.map(|(name, value)| (format!("{name}[{joint}]"), *value)).collect()
        };
        Decoded { stamp_ns: self.header.stamp_ns(), values: joints.flat_map(of_joint).collect() }
    }
}

/// Plain CDR of either byte order, behind four bytes that say which.
fn cdr<'d, T: Deserialize<'d>>(data: &'d [u8]) -> Result<T, String> {
    let (head, body) = data.split_first_chunk::<4>().ok_or("is shorter than its head")?;
    let decoded = match head[..2] {
        [0, 0] => from_bytes::<T, BigEndian>(body),
        [0, 1] => from_bytes::<T, LittleEndian>(body),
        [first, second] => {
            return Err(format!(
                "encoding {first:02x} {second:02x} is not plain CDR (00 00, 00 01)"
            ));
        }
        _ => return Err("is shorter than its head".to_owned()),
    };
    decoded.map(|(message, _)| message).map_err(|error| error.to_string())
}
