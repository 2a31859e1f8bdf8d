//! See `fuzz_entries::targets::log_csv`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz_entries::targets::log_csv::run(bytes));
