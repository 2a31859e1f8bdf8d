//! See `fuzz_entries::targets::block_decoder`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz_entries::targets::block_decoder::run(bytes));
