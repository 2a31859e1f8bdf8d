//! What goes into the board's flash, as far as that can be tested without a probe.
#![allow(missing_docs)]

use std::path::Path;

use assert_cmd::Command;
use firmware::store::{Layout, Slot};
use link::flash_image::check::unchanged;
use link::flash_image::parameters::next_slot;
use link::flash_image::{FlashError, FlashImage, Piece};
use model::reference_robot::reference_robot;
use rig::{Rig, plan};

mod common;

const LAYOUT: Layout = Layout::G474;

fn rrr(arguments: &[&str]) -> assert_cmd::assert::Assert {
    Command::cargo_bin("rrr").unwrap().args(arguments).assert()
}

/// An ELF file for ARM with these segments.
fn elf(segments: &[(u32, &[u8])]) -> Vec<u8> {
    let half = |value: u16| value.to_le_bytes().to_vec();
    let word = |value: u32| value.to_le_bytes().to_vec();
    let content = 52 + 32 * segments.len() as u32;
    let mut file = [b"\x7FELF\x01\x01\x01".to_vec(), vec![0; 9]].concat();
    file.extend(
        [half(2), half(40), word(1), word(0x0800_0001), word(52), word(0), word(0)].concat(),
    );
    let count = segments.len() as u16;
    file.extend([half(52), half(32), half(count), half(40), half(0), half(0)].concat());
    let mut at = content;
    for (address, bytes) in segments {
        let length = bytes.len() as u32;
        let fields = [1, at, *address, *address, length, length, 5, 4];
        file.extend(fields.map(u32::to_le_bytes).concat());
        at += length;
    }
    segments.iter().for_each(|(_, bytes)| file.extend_from_slice(bytes));
    file
}

fn image(segments: &[(u32, &[u8])]) -> FlashImage {
    FlashImage::of_elf(Path::new("firmware.elf"), &elf(segments)).unwrap()
}

#[test]
fn firmware_lies_where_its_file_says() {
    let image = image(&[(0x0800_0000, &[1; 16]), (0x0800_4000, &[2; 5])]);
    let expected = [(0x0800_0000, vec![1; 16]), (0x0800_4000, vec![2; 5])]
        .map(|(address, bytes)| Piece { address, bytes });
    assert_eq!(image.pieces, expected);
    image.check(None).unwrap();
}

#[test]
fn firmware_may_not_touch_bank_2() {
    for (address, bytes) in [
        (LAYOUT.slot(Slot::A), 8),
        (LAYOUT.slot(Slot::B), 8),
        (LAYOUT.faults[0], 8),
        (LAYOUT.key[1], 8),
        (LAYOUT.bank_start - 4, 8),
        (0x0807_FFF8, 8),
    ] {
        let content = vec![0; bytes];
        let error = image(&[(0x0800_0000, &[1; 16]), (address, &content)]).check(None).unwrap_err();
        assert!(matches!(error, FlashError::NotTheSlot { chosen: None, .. }), "{error}");
        assert!(error.to_string().contains(&format!("from 0x{address:08X}")), "{error}");
    }
}

#[test]
fn parameters_may_touch_their_slot_alone() {
    for slot in Slot::BOTH {
        let start = LAYOUT.slot(slot);
        let of = |address, bytes| FlashImage { pieces: vec![Piece { address, bytes }] };
        of(start, vec![0; 2048]).check(Some(slot)).unwrap();
        for (address, bytes) in
            [(start, 2049), (start + 8, 2048), (start - 8, 16), (LAYOUT.slot(slot.other()), 8)]
        {
            let error = of(address, vec![0; bytes]).check(Some(slot)).unwrap_err();
            assert!(!error.to_string().is_empty());
        }
    }
}

#[test]
fn what_lies_outside_flash_or_twice_in_it_is_refused() {
    for address in [0, 0x07FF_FFFC, 0x0808_0000, 0x2000_0000, 0xFFFF_FFF0] {
        let error = image(&[(address, &[0; 32])]).check(None).unwrap_err();
        assert!(matches!(error, FlashError::NotFlash { .. }), "{error}");
    }
    let twice = image(&[(0x0800_0010, &[1; 16]), (0x0800_0000, &[1; 17])]);
    assert!(matches!(twice.check(None), Err(FlashError::Overlap { address: 0x0800_0010 })));
}

#[test]
fn every_byte_of_bank_2_but_the_written_page_must_stay() {
    let block = plan::hold(10.0).block(&Rig::new(reference_robot()));
    let before = vec![0x5A; LAYOUT.used_bytes() as usize];
    for slot in Slot::BOTH {
        let image = FlashImage::of_block(&block, slot, 1).unwrap();
        let page = (LAYOUT.slot(slot) - LAYOUT.bank_start) as usize;
        let page = page..page + LAYOUT.page_bytes as usize;
        for at in 0..before.len() {
            let mut after = before.clone();
            after[at] = 0xFF;
            let found = unchanged(&before, &after, &image);
            assert_eq!(found.is_ok(), page.contains(&at), "byte {at}: {found:?}");
        }
    }
}

#[test]
fn what_has_changed_by_mistake_is_named() {
    let before = vec![0xFF; LAYOUT.used_bytes() as usize];
    for (address, place) in [
        (LAYOUT.slot(Slot::B) + 5, "the parameter block, slot B"),
        (LAYOUT.faults[0], "the fault record, slot A"),
        (LAYOUT.key[1] + 2047, "the key record, slot B"),
        (LAYOUT.bank_start + 2048, "an empty page of bank 2"),
    ] {
        let mut after = before.clone();
        after[(address - LAYOUT.bank_start) as usize] = 0;
        let error = unchanged(&before, &after, &FlashImage::default()).unwrap_err();
        let expected = format!("at 0x{address:08X} ({place}) the flash was not to be touched");
        assert!(error.to_string().starts_with(&expected), "{error}");
    }
    let cut_short = &before[..before.len() - 1];
    assert!(unchanged(&before, cut_short, &FlashImage::default()).is_err());
}

#[test]
fn the_next_block_goes_where_the_board_would_put_it() {
    let erased = vec![0xFF; LAYOUT.used_bytes() as usize];
    assert_eq!(next_slot(erased.clone()).unwrap(), (Slot::A, 1));
    let mut one = erased;
    let block = plan::hold(10.0).block(&Rig::new(reference_robot()));
    let record = &FlashImage::of_block(&block, Slot::A, 41).unwrap().pieces[0];
    one[..record.bytes.len()].copy_from_slice(&record.bytes);
    assert_eq!(next_slot(one).unwrap(), (Slot::B, 42));
}

#[test]
fn files_that_are_no_firmware_are_refused_before_a_probe_is_looked_for() {
    let directory = tempfile::tempdir().unwrap();
    let into_bank_2 = elf(&[(LAYOUT.slot(Slot::A), &[0; 8])]);
    let cut_short = elf(&[(0x0800_0000, &[0; 64])])[..100].to_vec();
    for (bytes, message) in [
        (into_bank_2, "in bank 2; there it may touch nothing alone"),
        (elf(&[(0, &[0; 8])]), "the board's flash is from 0x08000000"),
        (elf(&[]), "holds nothing that goes into flash"),
        (cut_short, "is no 32-bit ELF file"),
        (b"not an ELF file".to_vec(), "is no 32-bit ELF file"),
    ] {
        let file = directory.path().join("firmware.elf");
        std::fs::write(&file, bytes).unwrap();
        let run = rrr(&["flash", "--firmware", file.to_str().unwrap()]).code(2);
        let said = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
        assert!(said.contains(message) && said.contains("hint: "), "{said}");
    }
}

#[cfg(feature = "probe")]
#[test]
fn without_a_probe_it_says_so_and_what_to_do() {
    let failure = host_tool::failure::Failure::from(FlashError::NoProbe);
    assert_eq!(failure.message, "no debug probe is connected");
    assert!(failure.hint.contains("rrr export-block"), "{}", failure.hint);
    // With a probe, the command would write to whatever hangs there.
    if !link::flash_image::probe::connected().is_empty() {
        return;
    }
    let directory = common::with_model();
    let model = directory.path().join("model.toml");
    let run = rrr(&["flash", "--model", model.to_str().unwrap()]).code(2);
    let said = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    assert!(
        said.contains("error: no debug probe is connected\nhint: connect the NUCLEO"),
        "{said}"
    );
}
