//! Logs, data sets and models as they lie on disk.
//!
//! Every error names the file, the line and the column where there is one, what is
//! wrong, and through [`FileError::cure`] what to do about it. Writers leave either
//! the whole new file or what was there before.

#![forbid(unsafe_code)]

mod appending;
mod bytes;
pub mod dataset;
pub mod error;
pub mod excitation_file;
pub mod log;
mod number;
pub mod replace;
pub mod robot_file;
pub mod settings;
pub mod table;
mod toml_source;

pub use dataset::{Dataset, Entry, Experiment, Recording, Role};
pub use error::{FileError, Problem};
pub use excitation_file::ExcitationFile;
pub use log::{BoardSample, JointLog, Log, Position};
pub use robot_file::{EffectTable, FrictionTable, PendulumTable, RobotFile, RobotTable};
