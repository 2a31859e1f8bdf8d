//! The power fails in every operation of the flash; the board begins with the old or the new.
#![allow(missing_docs)]

mod common;

use common::{board_alone, commit, done, encoded, image};
use emulator::operator::Operator;
use emulator::registers::flash::Torn;
use firmware::checksum::CRC_32C;
use firmware::link::{Command, Report};
use firmware::supervisor::{Fault, State};
use firmware::{Mode, ParameterBlock};
use model::reference_robot::reference_robot;
use rig::{Rig, plan};

/// What the operation that was cut leaves.
const TORN: [Torn; 3] = [Torn::Unreadable, Torn::Untouched, Torn::Done];

/// Operations whose cut is tried; all of them with `RRR_SOAK`, every so many-th without.
fn step() -> usize {
    if std::env::var_os("RRR_SOAK").is_some() { 1 } else { 5 }
}

fn block(number: u32) -> ParameterBlock {
    let block = plan::task(20.0).with_mode(Mode::PdModel).block(&Rig::new(reference_robot()));
    ParameterBlock { command_limit_v: 1.0 + number as f32 / 1000.0, ..block }
}

fn checksum(block: &ParameterBlock) -> u32 {
    CRC_32C.checksum(&encoded(block))
}

/// How the board is after its boot.
fn booted(board: &mut Operator) -> Report {
    board.run_ms(100).unwrap();
    assert!(board.hello().unwrap());
    board.query().unwrap().unwrap()
}

fn in_use(board: &mut Operator) -> u32 {
    booted(board).parameters.unwrap().checksum
}

#[test]
fn cut_in_a_commit_the_board_begins_with_the_old_or_the_new_block() {
    let Some(image) = image() else { return };
    let mut board = board_alone(&image);
    board.run_ms(50).unwrap();
    commit(&mut board, &block(1));
    let before = board.machine.board().flash.operations;
    commit(&mut board, &block(2));
    let operations = board.machine.board().flash.operations - before;
    let (mut old, mut new) = (0, 0);
    // Every cut with every outcome where all are tried.
    let rounds = if step() == 1 { 3 } else { 1 };
    let cuts =
        (0..rounds).flat_map(|round| (1..=operations).step_by(step()).map(move |c| (round, c)));
    for (number, (round, cut)) in cuts.enumerate() {
        let number = number as u32 + 3;
        let [last, next] = [number - 1, number].map(|n| checksum(&block(n)));
        let resets = board.machine.resets.len();
        assert!(board.hello().unwrap());
        assert_eq!(board.upload(&encoded(&block(number))).unwrap(), Some(Ok(())));
        let now = board.machine.board().flash.operations;
        board.machine.board().flash.torn = TORN[(cut + round) as usize % 3];
        board.machine.board().flash.cut_at = Some(now + cut);
        assert_eq!(board.ask(Command::Commit).unwrap(), None, "cut {cut}");
        assert_eq!(board.machine.resets.len(), resets + 1);
        let found = in_use(&mut board);
        assert!([last, next].contains(&found), "cut {cut}: {found:08X}");
        (old, new) = (old + u32::from(found == last), new + u32::from(found == next));
        // It is stored the next time, whatever was left.
        commit(&mut board, &block(number));
        assert_eq!(in_use(&mut board), next);
    }
    println!("{operations} operations; {old} cuts left the old block, {new} the new one");
    assert!(old > 0 && board.machine.board().trace.faults.is_empty());
}

#[test]
fn cut_while_a_fault_is_stored_the_board_comes_up_with_it_or_without() {
    let Some(image) = image() else { return };
    let mut board = board_alone(&image);
    board.run_ms(50).unwrap();
    commit(&mut board, &block(1));
    let (mut with, mut without, mut cut) = (0, 0, 1);
    loop {
        assert!(board.hello().unwrap());
        let now = board.machine.board().flash.operations;
        board.machine.board().flash.torn = TORN[(cut as usize + 2) % 3];
        board.machine.board().flash.cut_at = Some(now + cut);
        let resets = board.machine.resets.len();
        // The library reports an overrun that nobody armed for; a broken parameter is a fault.
        corrupt_parameters(&mut board);
        board.run_ms(1300).unwrap();
        board.machine.board().flash.cut_at = None;
        if board.machine.resets.len() == resets {
            break;
        }
        let report = booted(&mut board);
        match report.state {
            State::Faulted => with += 1,
            state => {
                assert_eq!(state, State::Disarmed, "cut {cut}");
                without += 1;
            }
        }
        assert_eq!(report.parameters.unwrap().checksum, checksum(&block(1)), "cut {cut}");
        if report.state == State::Faulted {
            done(&mut board, Command::ClearFault);
        }
        cut += 1;
    }
    println!("{} cuts: {with} left the fault, {without} none", cut - 1);
    let report = board.query().unwrap().unwrap();
    assert_eq!(report.fault.map(|fault| fault.fault), Some(Fault::CorruptParameters));
    assert!(cut > 2, "{cut}");
}

/// Changes a bit of the parameters in use, in the RAM.
fn corrupt_parameters(board: &mut Operator) {
    let limit = block(1).command_limit_v.to_le_bytes();
    let start = emulator::memory_map::RAM_START;
    let ram = board.machine.ram(start, emulator::memory_map::RAM_BYTES);
    let found: Vec<u32> = ram
        .windows(4)
        .enumerate()
        .step_by(4)
        .filter(|(_, w)| *w == limit)
        .map(|(i, _)| start + i as u32)
        .collect();
    for address in found {
        board.machine.set_ram(address, &(2.0_f32).to_le_bytes());
    }
}
