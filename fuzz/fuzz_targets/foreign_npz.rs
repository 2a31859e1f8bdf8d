//! See `fuzz_entries::targets::foreign_npz`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz_entries::targets::foreign_npz::run(bytes));
