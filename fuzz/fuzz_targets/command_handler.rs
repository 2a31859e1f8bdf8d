//! See `fuzz_entries::targets::command_handler`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz_entries::targets::command_handler::run(bytes));
