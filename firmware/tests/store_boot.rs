//! Which block the board begins with, and what it says about it.
#![allow(missing_docs)]

mod common;
mod failing_flash;

use common::block;
use failing_flash::{FailingFlash, LAYOUT, Torn, store};
use firmware::block::{MAX_BYTES, VERSION};
use firmware::store::{
    Content, Kind, NOTE_BYTES, RamFlash, Slot, Source, Store, StoreError, slot_record,
};
use firmware::{BlockError, Controller, Mode};

fn encoded(mode: Mode) -> Vec<u8> {
    let mut buffer = [0; MAX_BYTES];
    block(mode).encode(&mut buffer).unwrap().to_vec()
}

/// The same bytes under another version, with a checksum that fits.
fn as_version(version: u16) -> Vec<u8> {
    let mut bytes = encoded(Mode::Pd);
    let end = bytes.len() - 4;
    bytes[0..2].copy_from_slice(&version.to_le_bytes());
    let checksum = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC).checksum(&bytes[..end]);
    bytes[end..].copy_from_slice(&checksum.to_le_bytes());
    bytes
}

/// A record as the format has it, written out here once more.
fn record(sequence: u32, body: &[u8]) -> Vec<u8> {
    let crc = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);
    let filled = [body, &vec![0xFF; body.len().next_multiple_of(8) - body.len()]].concat();
    let (sequence, length) = (sequence.to_le_bytes(), (body.len() as u16).to_le_bytes());
    let head = [&b"RRRP"[..], &sequence, &length, &[1, 0]].concat();
    let checksum = crc.checksum(&[&head[..], &filled].concat()).to_le_bytes();
    [&head[..], &checksum, &sequence, &sequence.map(|byte| !byte), &filled].concat()
}

#[test]
fn a_record_lies_in_flash_as_the_format_says() {
    let mut one = store(FailingFlash::new());
    one.commit(&encoded(Mode::Pd)).unwrap();
    let expected = record(1, &encoded(Mode::Pd));
    let mut buffer = [0; 2048];
    assert_eq!(slot_record(1, &encoded(Mode::Pd), &mut buffer), Some(&expected[..]));
    let flash = one.into_flash();
    assert_eq!(&flash.bytes()[..expected.len()], expected);
    assert!(flash.bytes()[expected.len()..].iter().all(|byte| *byte == 0xFF));
}

#[test]
fn blocks_go_to_the_slots_in_turn() {
    let mut store = store(FailingFlash::new());
    for (sequence, slot) in (1..).zip([Slot::A, Slot::B, Slot::A, Slot::B]) {
        let stored = store.commit(&encoded(Mode::PdModel)).unwrap();
        assert_eq!((stored.slot, stored.sequence), (slot, sequence));
        assert_eq!(store.boot().source, Source::Newest { slot, sequence });
        let mut buffer = [0; MAX_BYTES];
        let newest = store.newest(&mut buffer).unwrap();
        assert_eq!(newest, stored);
        assert_eq!(buffer[..newest.length], encoded(Mode::PdModel));
    }
}

#[test]
fn an_empty_board_puts_out_nothing() {
    let boot = store(FailingFlash::new()).boot();
    assert_eq!(boot.source, Source::Defaults);
    assert_eq!(
        boot.to_string(),
        "parameters: safe defaults, because slot A at 0x08040000 is empty and \
         slot B at 0x08041000 is empty"
    );
    boot.block.check().unwrap();
    let mut controller = Controller::new(boot.block);
    controller.start();
    for tick in 0..3000 {
        let codes = controller.tick(&[tick * 50, -tick * 90, tick]).codes;
        assert!(codes.iter().all(|code| code.0 == 0), "{codes:?}");
    }
}

/// A block whose layout this build does not know, found in a slot as another firmware left it.
#[test]
fn a_block_of_another_version_is_refused_in_words_and_never_reinterpreted() {
    for version in [1, VERSION + 1] {
        let mut both = store(FailingFlash::new());
        both.commit(&encoded(Mode::Pd)).unwrap();
        let record = record(2, &as_version(version));
        let mut flash = both.into_flash();
        flash.bytes_mut()[0x1000..][..record.len()].copy_from_slice(&record);
        let mut both = store(flash);
        let boot = both.boot();
        assert_eq!(boot.source, Source::Other { slot: Slot::A, sequence: 1 });
        assert_eq!(boot.slots[1].refused, Some(BlockError::Version { found: version }));
        let said = format!(
            "slot B at 0x08041000 holds block 2, which is refused: the block has version {version}"
        );
        assert!(boot.to_string().contains(&said), "{boot}");
        // The next block takes the place of the one refused, and counts on from it.
        let stored = both.commit(&encoded(Mode::PdModel)).unwrap();
        assert_eq!((stored.slot, stored.sequence), (Slot::B, 3));
    }
}

#[test]
fn a_block_that_would_be_refused_is_not_stored() {
    let mut one = store(FailingFlash::new());
    one.commit(&encoded(Mode::Pd)).unwrap();
    let before = one.boot();
    let error = one.commit(&as_version(1)).unwrap_err();
    assert_eq!(error, StoreError::Refused(BlockError::Version { found: 1 }));
    assert!(one.commit(&encoded(Mode::Pd)[1..]).is_err());
    assert_eq!(one.boot(), before);
}

#[test]
fn errors_name_the_slot_and_its_address() {
    let mut one = store(FailingFlash::new());
    one.commit(&encoded(Mode::Pd)).unwrap();
    let flash = one.into_flash();
    let erasing = store(flash.clone().powered(1000, Torn::SomeBits)).commit(&encoded(Mode::Pd));
    let text = erasing.unwrap_err().to_string();
    assert!(text.starts_with("parameter block, slot B at 0x08041000: cannot be erased"), "{text}");
    let writing = store(flash.powered(2100, Torn::SomeBits)).commit(&encoded(Mode::Pd));
    let text = writing.unwrap_err().to_string();
    assert!(text.starts_with("parameter block, slot B at 0x08041000: cannot be written"), "{text}");
}

#[test]
fn flash_that_cannot_be_read_is_no_reason_to_stop() {
    let mut two = store(FailingFlash::new());
    two.commit(&encoded(Mode::Pd)).unwrap();
    two.commit(&encoded(Mode::PdModel)).unwrap();
    let mut flash = two.into_flash();
    flash.break_word((LAYOUT.slot(Slot::B) - LAYOUT.bank_start) as usize + 100);
    let mut broken = store(flash);
    let boot = broken.boot();
    assert_eq!(boot.source, Source::Other { slot: Slot::A, sequence: 1 });
    assert_eq!(boot.slots[1].content, Content::Unreadable);
    assert_eq!(broken.commit(&encoded(Mode::PdModel)).unwrap().slot, Slot::B);
}

#[test]
fn notes_are_kept_apart_and_forgotten_when_empty() {
    let mut store = Store::new(
        RamFlash::new(vec![0xFF; LAYOUT.used_bytes() as usize]),
        LAYOUT.bank_start,
        LAYOUT,
    );
    let mut found = [0; NOTE_BYTES];
    assert_eq!(store.read_note(Kind::Fault, &mut found), None);
    store.commit(&encoded(Mode::PdModel)).unwrap();
    for number in 0..200 {
        store.write_note(Kind::Fault, &[number; 5]).unwrap();
        store.write_note(Kind::Key, &[!number; 32]).unwrap();
        assert_eq!(store.read_note(Kind::Fault, &mut found), Some(5));
        assert_eq!(found[..5], [number; 5]);
        assert_eq!(store.read_note(Kind::Key, &mut found), Some(32));
        assert_eq!(found[..32], [!number; 32]);
    }
    store.write_note(Kind::Fault, &[]).unwrap();
    assert_eq!(store.read_note(Kind::Fault, &mut found), Some(0));
    let too_long = store.write_note(Kind::Key, &[0; NOTE_BYTES + 1]).unwrap_err();
    assert_eq!(too_long.to_string(), "the key record has 41 bytes, there is room for 40");
    assert_eq!(store.boot().block, block(Mode::PdModel));
}
