//! See `fuzz_entries::targets::foreign_text`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz_entries::targets::foreign_text::run(bytes));
