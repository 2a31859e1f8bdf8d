//! See `fuzz_entries::targets::store_reader`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz_entries::targets::store_reader::run(bytes));
