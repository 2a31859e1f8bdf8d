//! See `fuzz_entries::targets::log_mcap`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz_entries::targets::log_mcap::run(bytes));
