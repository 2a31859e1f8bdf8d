//! One file a target.

pub mod block_decoder;
pub mod command_handler;
mod foreign;
pub mod foreign_npz;
pub mod foreign_parquet;
pub mod foreign_rosbag2;
pub mod foreign_text;
pub mod frame_decoder;
pub mod log_csv;
pub mod log_mcap;
pub mod store_reader;
pub mod toml_files;
