//! See `fuzz_entries::targets::foreign_rosbag2`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz_entries::targets::foreign_rosbag2::run(bytes));
