//! Every single flipped bit of a stored block is detected.
#![allow(missing_docs)]

mod common;
mod failing_flash;

use common::block;
use failing_flash::{FailingFlash, LAYOUT, store};
use firmware::Mode;
use firmware::block::MAX_BYTES;
use firmware::store::{Kind, NOTE_BYTES, Slot, Source};

fn encoded(mode: Mode) -> Vec<u8> {
    let mut buffer = [0; MAX_BYTES];
    block(mode).encode(&mut buffer).unwrap().to_vec()
}

fn flip(flash: &FailingFlash, byte: usize, bit: usize) -> FailingFlash {
    let mut flipped = flash.clone();
    flipped.bytes_mut()[byte] ^= 1 << bit;
    flipped
}

/// Header, mark and body, filled up to whole words.
fn record_bytes(body: usize) -> usize {
    24 + body.next_multiple_of(8)
}

#[test]
fn a_flipped_bit_in_the_newest_block_brings_back_the_other() {
    let mut two = store(FailingFlash::new());
    two.commit(&encoded(Mode::Pd)).unwrap();
    two.commit(&encoded(Mode::PdModel)).unwrap();
    let flash = two.into_flash();
    let newest = (LAYOUT.slot(Slot::B) - LAYOUT.bank_start) as usize;
    let bytes = record_bytes(encoded(Mode::PdModel).len());
    for byte in newest..newest + bytes {
        for bit in 0..8 {
            let boot = store(flip(&flash, byte, bit)).boot();
            assert_eq!(boot.source, Source::Other { slot: Slot::A, sequence: 1 }, "{byte}.{bit}");
            assert_eq!(boot.block, block(Mode::Pd));
            assert!(boot.to_string().contains("slot B at 0x08041000 holds a"), "{boot}");
        }
    }
    println!("{} bits", 8 * bytes);
    assert_eq!(8 * bytes, 3_264);
}

#[test]
fn a_flipped_bit_in_the_only_block_leaves_the_safe_defaults() {
    let mut one = store(FailingFlash::new());
    one.commit(&encoded(Mode::PdModel)).unwrap();
    let flash = one.into_flash();
    for byte in 0..record_bytes(encoded(Mode::PdModel).len()) {
        for bit in 0..8 {
            let boot = store(flip(&flash, byte, bit)).boot();
            assert_eq!(boot.source, Source::Defaults, "{byte}.{bit}");
            assert_eq!(boot.block.mode, [Mode::OpenLoop; 3]);
        }
    }
}

#[test]
fn a_flipped_bit_in_a_note_brings_back_the_one_before() {
    let mut notes = store(FailingFlash::new());
    notes.write_note(Kind::Key, &[1; NOTE_BYTES]).unwrap();
    notes.write_note(Kind::Key, &[2; NOTE_BYTES]).unwrap();
    let flash = notes.into_flash();
    let second = (LAYOUT.key[0] - LAYOUT.bank_start) as usize + 64;
    for byte in second..second + 64 {
        for bit in 0..8 {
            let mut found = [0; NOTE_BYTES];
            store(flip(&flash, byte, bit)).read_note(Kind::Key, &mut found).unwrap();
            assert_eq!(found, [1; NOTE_BYTES], "{byte}.{bit}");
        }
    }
}
