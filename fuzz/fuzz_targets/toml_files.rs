//! See `fuzz_entries::targets::toml_files`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz_entries::targets::toml_files::run(bytes));
