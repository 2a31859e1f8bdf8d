//! Logs, data sets and models as they lie on disk.
//!
//! Every error names the file, the line and the column where there is one, what is
//! wrong, and through [`FileError::hint`] what to do about it. Writers leave either
//! the whole new file or what was there before.
//!
//! A log is written whole or not at all; a CSV log holds rounded decimals:
//!
//! ```
//! use files::{JointLog, Log, Position};
//!
//! let path = std::env::temp_dir().join("one-joint-at-rest.csv.gz");
//! let time_s: Vec<f64> = (0..100).map(|k| f64::from(k) / 1000.0).collect();
//! let joint = JointLog {
//!     joint: 3,
//!     position: Position::Count(vec![0; 100]),
//!     command_v: vec![0.1; 100],
//!     reference_rad: None,
//! };
//! let log = Log { time_s, joints: vec![joint] };
//! log.write(&path)?;
//! assert_eq!(Log::read(&path)?, log);
//! # std::fs::remove_file(path).unwrap();
//! # Ok::<(), files::FileError>(())
//! ```
#![forbid(unsafe_code)]

mod appending;
pub mod arm_file;
pub mod arm_log;
mod bytes;
pub mod dataset;
pub mod error;
pub mod example_arms;
pub mod excitation_file;
pub mod foreign;
pub mod guess;
pub mod import;
mod known_keys;
pub mod log;
pub mod mapping;
mod mcap_records;
mod number;
pub mod quantity;
pub mod replace;
pub mod robot_file;
mod section;
pub mod settings;
mod simulated_list;
pub mod table;
mod toml_source;

pub use arm_file::{ArmFile, ArmJoint};
pub use arm_log::{ArmJointLog, ArmLog};
pub use dataset::{Dataset, Entry, Experiment, Recording, Role};
pub use error::{FileError, Problem};
pub use excitation_file::ExcitationFile;
pub use log::{BoardSample, GrowingCsv, JointLog, Log, McapDetails, Position};
pub use robot_file::{EffectTable, FrictionTable, PendulumTable, RobotFile, RobotTable};
