//! What is fuzzed: a function of bytes each, which must neither panic nor hang.
//!
//! cargo-fuzz calls them with bytes that cover more and more of the code (`fuzz/`); the plain
//! runner of this crate damages good inputs at random, on any compiler.
#![forbid(unsafe_code)]

pub mod foreign_seeds;
pub mod mutate;
pub mod rng;
pub mod seeds;
pub mod targets;

/// Something that takes bytes from outside.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its name, that of cargo-fuzz's binary as well.
    pub name: &'static str,
    /// Gives it the bytes.
    pub run: fn(&[u8]),
    /// Good inputs to begin from.
    pub seeds: fn() -> Vec<Vec<u8>>,
}

/// All of them.
pub const TARGETS: [Target; 11] = [
    Target { name: "frame_decoder", run: targets::frame_decoder::run, seeds: seeds::frames },
    Target { name: "block_decoder", run: targets::block_decoder::run, seeds: seeds::blocks },
    Target {
        name: "command_handler",
        run: targets::command_handler::run,
        seeds: seeds::conversations,
    },
    Target { name: "store_reader", run: targets::store_reader::run, seeds: seeds::banks },
    Target { name: "log_csv", run: targets::log_csv::run, seeds: seeds::logs_csv },
    Target { name: "log_mcap", run: targets::log_mcap::run, seeds: seeds::logs_mcap },
    Target { name: "foreign_text", run: targets::foreign_text::run, seeds: foreign_seeds::texts },
    Target { name: "foreign_npz", run: targets::foreign_npz::run, seeds: foreign_seeds::archives },
    Target {
        name: "foreign_parquet",
        run: targets::foreign_parquet::run,
        seeds: foreign_seeds::parquets,
    },
    Target {
        name: "foreign_rosbag2",
        run: targets::foreign_rosbag2::run,
        seeds: foreign_seeds::recordings,
    },
    Target { name: "toml_files", run: targets::toml_files::run, seeds: seeds::toml_files },
];
