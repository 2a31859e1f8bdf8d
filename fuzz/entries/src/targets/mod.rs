//! One file a target.

pub mod block_decoder;
pub mod command_handler;
pub mod frame_decoder;
pub mod log_csv;
pub mod log_mcap;
pub mod store_reader;
pub mod toml_files;
