//! See `fuzz_entries::targets::frame_decoder`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz_entries::targets::frame_decoder::run(bytes));
