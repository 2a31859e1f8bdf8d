//! Files of others as tables: delimited text, NumPy, Parquet, rosbag2.
//!
//! No file here names its columns as a log does; which column is what, a mapping says.

mod delimited;
mod format;
mod guarded;
mod npy;
mod npz;
mod parquet;
mod parquet_column;
mod parquet_pages;
mod parquet_schema;
mod ros_message;
mod rosbag2;
mod rows;

use crate::table::Table;

pub use format::{is_readable, parse, read};
pub use rosbag2::{LOG_TIME, STAMP};

/// Columns of a file that have their rows in common.
#[derive(Clone, Debug, PartialEq)]
pub struct Stream {
    /// The topic in a recording of ROS; else empty, or what tells it from the file's others.
    pub name: String,
    /// Its columns; lists have a column for each element, `name[0]`, `name[1]`.
    pub table: Table,
}

/// Which columns are wanted, asked by name, that of a list without brackets.
pub type Wanted<'a> = &'a dyn Fn(&str) -> bool;

/// The name without the index in brackets.
pub fn base_name(column: &str) -> &str {
    match column.rsplit_once('[') {
        Some((base, _)) if column.ends_with(']') => base,
        _ => column,
    }
}
