//! What goes into the board's flash, as far as that can be tested without a probe.
#![allow(missing_docs)]

use std::path::Path;

use assert_cmd::Command;
use firmware::store::{Layout, RamFlash, Slot, Source, Store};
use firmware::{Mode, ParameterBlock};
use host_tool::commands::Failure;
use host_tool::files::RobotFile;
use host_tool::flash_image::parameters::next_slot;
use host_tool::flash_image::{FlashError, FlashImage, Piece};
use host_tool::simulation::{Rig, plan};
use model::reference_robot::reference_robot;

const LAYOUT: Layout = Layout::G474;

/// A model file; it goes with the value.
struct ModelFile(tempfile::TempDir);

impl ModelFile {
    fn new() -> Self {
        let directory = tempfile::tempdir().unwrap();
        let file = Self(directory);
        RobotFile::from_robot(&reference_robot()).write(file.path()).unwrap();
        file
    }

    fn path(&self) -> String {
        self.0.path().join("model.toml").to_str().unwrap().into()
    }
}

fn rrr(arguments: &[&str]) -> assert_cmd::assert::Assert {
    Command::cargo_bin("rrr").unwrap().args(arguments).assert()
}

/// What the board finds in bank 2 after this was written into erased flash.
fn booted(image: &FlashImage) -> (Source, ParameterBlock) {
    let mut bank = vec![0xFF; LAYOUT.used_bytes() as usize];
    for piece in &image.pieces {
        let from = (piece.address - LAYOUT.bank_start) as usize;
        bank[from..from + piece.bytes.len()].copy_from_slice(&piece.bytes);
    }
    let boot = Store::new(RamFlash::new(bank), LAYOUT.bank_start, LAYOUT).boot();
    (boot.source, boot.block)
}

/// The pieces of an Intel HEX file.
fn from_hex(text: &str) -> FlashImage {
    let mut upper = 0;
    let mut pieces = Vec::new();
    for record in ihex::Reader::new(text) {
        match record.unwrap() {
            ihex::Record::ExtendedLinearAddress(half) => upper = u32::from(half) << 16,
            ihex::Record::Data { offset, value } => {
                pieces.push(Piece { address: upper + u32::from(offset), bytes: value });
            }
            _ => {}
        }
    }
    FlashImage { pieces }
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
fn an_exported_block_is_what_the_board_begins_with() {
    let (directory, model) = (tempfile::tempdir().unwrap(), ModelFile::new());
    for (slot, letter) in [(Slot::A, "a"), (Slot::B, "b")] {
        let [bin, hex] = ["bin", "hex"].map(|ending| directory.path().join(format!("p.{ending}")));
        for out in [&bin, &hex] {
            let out = out.to_str().unwrap();
            rrr(&[
                "export-block",
                &model.path(),
                "--out",
                out,
                "--slot",
                letter,
                "--sequence",
                "7",
            ])
            .success();
        }
        let from_hex = from_hex(&std::fs::read_to_string(hex).unwrap());
        from_hex.check(Some(slot)).unwrap();
        assert!(from_hex.check(Some(slot.other())).is_err());
        let from_bin = Piece { address: LAYOUT.slot(slot), bytes: std::fs::read(bin).unwrap() };
        let from_bin = FlashImage { pieces: vec![from_bin] };
        for image in [&from_hex, &from_bin] {
            let (source, block) = booted(image);
            assert_eq!(source, Source::Newest { slot, sequence: 7 });
            assert_eq!(block.mode, [Mode::PdModel; 3]);
        }
        assert_eq!(booted(&from_hex).1, booted(&from_bin).1);
    }
}

#[test]
fn options_of_an_exported_block_reach_it() {
    let (directory, model) = (tempfile::tempdir().unwrap(), ModelFile::new());
    let out = directory.path().join("params.hex");
    let out = out.to_str().unwrap();
    let options = ["--mode", "pd", "--reference", "task", "--command-limit-v", "1.5"];
    rrr(&[&["export-block", &model.path(), "--out", out][..], &options].concat()).success();
    let (_, block) = booted(&from_hex(&std::fs::read_to_string(out).unwrap()));
    assert_eq!((block.mode, block.command_limit_v), ([Mode::Pd; 3], 1.5));
    assert_eq!(block.reference.duration_s, 20.0);
}

#[test]
fn what_cannot_be_exported_is_named_and_leaves_no_file() {
    let (directory, model) = (tempfile::tempdir().unwrap(), ModelFile::new());
    for (options, message) in [
        (["--out", "params.elf", "--mode", "pd"], "--out params.elf: ends neither in .bin"),
        (["--out", "params.bin", "--mode", "fast"], "--mode fast: no such mode"),
        (["--out", "params.bin", "--reference", "x"], "--reference x: no such reference"),
        (["--out", "params.bin", "--command-limit-v", "11"], "--command-limit-v 11"),
    ] {
        let run = Command::cargo_bin("rrr")
            .unwrap()
            .current_dir(directory.path())
            .args([&["export-block", &model.path()][..], &options].concat())
            .assert()
            .code(2);
        let said = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
        assert!(said.contains(message) && said.contains("hint: "), "{said}");
    }
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 0);
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
    let failure = Failure::from(FlashError::NoProbe);
    assert_eq!(failure.message, "no debug probe is connected");
    assert!(failure.hint.contains("rrr export-block"), "{}", failure.hint);
    // With a probe, the command would write to whatever hangs there.
    if !host_tool::flash_image::probe::connected().is_empty() {
        return;
    }
    let model = ModelFile::new();
    let run = rrr(&["flash", "--model", &model.path()]).code(2);
    let said = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    assert!(
        said.contains("error: no debug probe is connected\nhint: connect the NUCLEO"),
        "{said}"
    );
}
