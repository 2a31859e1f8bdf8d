//! A model as the image of a parameter slot: what is written, and what is refused.
#![allow(missing_docs)]

use std::path::Path;

use assert_cmd::Command;
use files::RobotFile;
use firmware::store::{Layout, RamFlash, Slot, Source, Store};
use firmware::{Mode, ParameterBlock};
use link::flash_image::parameters::next_slot;
use link::flash_image::{FlashImage, Piece};
use model::reference_robot::reference_robot;

mod common;
use common::with_model;

const LAYOUT: Layout = Layout::G474;

fn rrr(directory: &Path, line: &str) -> assert_cmd::assert::Assert {
    Command::cargo_bin("rrr").unwrap().current_dir(directory).args(line.split(' ')).assert()
}

/// What it says with exit status 2.
fn refused(directory: &Path, line: &str) -> String {
    let run = rrr(directory, line).code(2);
    String::from_utf8(run.get_output().stderr.clone()).unwrap()
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

#[test]
fn an_exported_block_is_what_the_board_begins_with() {
    let directory = with_model();
    let at = directory.path();
    for (slot, letter) in [(Slot::A, "a"), (Slot::B, "b")] {
        for out in ["p.bin", "p.hex"] {
            let options = format!("--slot {letter} --sequence 7");
            rrr(at, &format!("export-block model.toml --out {out} {options}")).success();
        }
        let from_hex = from_hex(&std::fs::read_to_string(at.join("p.hex")).unwrap());
        from_hex.check(Some(slot)).unwrap();
        assert!(from_hex.check(Some(slot.other())).is_err());
        let bytes = std::fs::read(at.join("p.bin")).unwrap();
        let from_bin = FlashImage { pieces: vec![Piece { address: LAYOUT.slot(slot), bytes }] };
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
    let directory = with_model();
    let at = directory.path();
    let options = "--mode pd --reference task --command-limit-v 1.5";
    rrr(at, &format!("export-block model.toml --out params.hex {options}")).success();
    let text = std::fs::read_to_string(at.join("params.hex")).unwrap();
    let (_, block) = booted(&from_hex(&text));
    assert_eq!((block.mode, block.command_limit_v), ([Mode::Pd; 3], 1.5));
    assert_eq!(block.reference.duration_s, 20.0);
}

#[test]
fn a_hex_file_ends_with_its_last_record() {
    let directory = with_model();
    rrr(directory.path(), "export-block model.toml --out params.hex").success();
    let text = std::fs::read_to_string(directory.path().join("params.hex")).unwrap();
    let lines: Vec<&str> = text.split('\n').collect();
    assert_eq!(lines[lines.len() - 2..], [":00000001FF", ""]);
    assert!(lines[..lines.len() - 1].iter().all(|line| line.starts_with(':')), "{text}");
}

#[test]
fn what_cannot_be_exported_is_named_and_leaves_no_file() {
    let directory = with_model();
    for (options, message) in [
        ("--out params.elf --mode pd", "--out params.elf: ends neither in .bin"),
        ("--out params.bin --mode fast", "--mode fast: no such mode"),
        ("--out params.bin --reference x", "--reference x: no such reference"),
        ("--out params.bin --command-limit-v 11", "--command-limit-v 11"),
    ] {
        let said = refused(directory.path(), &format!("export-block model.toml {options}"));
        assert!(said.contains(message) && said.contains("hint: "), "{said}");
    }
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 1, "the model alone");
}

#[test]
fn a_model_beyond_a_hard_limit_is_neither_exported_nor_flashed_nor_uploaded() {
    let directory = with_model();
    let model = directory.path().join("model.toml");
    let text = std::fs::read_to_string(&model).unwrap();
    assert!(text.contains("[robot]\n"));
    let slower = text.replace("[robot]\n", "[robot]\nsample_period_s = 0.002\n");
    std::fs::write(model, slower).unwrap();
    for line in [
        "export-block model.toml --out params.bin",
        "export-block model.toml --out params.hex",
        "flash --model model.toml",
        "upload model.toml --port tcp:127.0.0.1:1",
    ] {
        let said = refused(directory.path(), line);
        let expected = "model.toml: the board refuses it: sample_period_s is 0.002";
        assert!(said.contains(expected), "{said}");
        assert!(said.contains("must be the board's, 0.001 s\nhint: "), "{said}");
    }
    assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 1, "the model alone");
}

#[test]
fn a_gain_beyond_its_hard_limit_is_refused_with_gain_and_limit() {
    let directory = with_model();
    let mut robot = reference_robot::<f64>();
    robot.torque_constant_nm_per_v[0] = 1e-3;
    RobotFile::from_robot(&robot).write(directory.path().join("model.toml")).unwrap();
    let said = refused(directory.path(), "export-block model.toml --out params.bin");
    assert!(said.contains("proportional_gain_V_per_rad of joint 1 is "), "{said}");
    assert!(said.contains("the board's hard limit, 10000\nhint: the gains are made of"), "{said}");
}

#[test]
fn a_sequence_number_that_bars_later_uploads_is_refused() {
    let directory = with_model();
    let at = directory.path();
    let line = |number: &str| format!("export-block model.toml --out p.bin --sequence {number}");
    for number in ["0", "2147483648", "4294967295"] {
        let said = refused(at, &line(number));
        assert!(said.contains(number) && said.contains("1..=2147483647"), "{said}");
        assert!(!at.join("p.bin").exists());
    }
    rrr(at, &line("2147483647")).success();
    let mut bank = vec![0xFF; LAYOUT.used_bytes() as usize];
    let bytes = std::fs::read(at.join("p.bin")).unwrap();
    bank[..bytes.len()].copy_from_slice(&bytes);
    assert_eq!(next_slot(bank).unwrap(), (Slot::B, 2_147_483_648));
}

// The model has an effect that no board compensates for, which is said before the block is made.
#[cfg(target_os = "linux")]
#[test]
fn full_outputs_end_in_status_2_and_not_in_a_panic() {
    let directory = with_model();
    let model = directory.path().join("model.toml");
    let effect = "[[effect]]\neffect = \"delay\"\njoint = 2\nparameters = { delay_s = 0.002 }\n";
    std::fs::write(&model, std::fs::read_to_string(&model).unwrap() + effect).unwrap();
    let full = || std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let line = "export-block model.toml --out p.bin --compensate";
    let mut command = std::process::Command::new(assert_cmd::cargo::cargo_bin("rrr"));
    command.current_dir(directory.path()).args(line.split(' ')).stdout(full()).stderr(full());
    assert_eq!(command.status().unwrap().code(), Some(2));
    assert!(!directory.path().join("p.bin").exists());
    assert_eq!(command.stdout(std::process::Stdio::null()).status().unwrap().code(), Some(0));
}

#[test]
fn tables_of_the_model_reach_the_board_and_are_said() {
    let directory = with_model();
    let path = directory.path().join("model.toml");
    let mut model = RobotFile::read(&path).unwrap();
    for axis in ["velocity", "time"] {
        let text = format!("table:2:axis={axis},knots=-1 0 1,values_V=-0.1 0 0.1");
        model.effects.push(rig::effects::table_from_text(&text).unwrap());
    }
    model.write(&path).unwrap();
    let line = "export-block model.toml --out p.bin --compensate --slot a --sequence 7";
    let run = rrr(directory.path(), line).success();
    let said = String::from_utf8(run.get_output().stdout.clone()).unwrap();
    assert!(said.contains("table of joint 2 over velocity is compensated: 3 knots"), "{said}");
    let why = "table of joint 2 is not compensated: the board does not know when";
    assert!(said.contains(why), "{said}");
    let bytes = std::fs::read(directory.path().join("p.bin")).unwrap();
    let image = FlashImage { pieces: vec![Piece { address: LAYOUT.slot(Slot::A), bytes }] };
    let block = booted(&image).1;
    assert_eq!(block.compensations.each_ref().map(|joint| joint.tables.len()), [0, 1, 0]);
}
