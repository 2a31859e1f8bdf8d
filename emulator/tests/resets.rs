//! Resets in the middle of a run, which are faults, and others, which are none.
#![allow(missing_docs)]

mod common;

use common::{after_ms, board_alone, cleared_after_ms, done, image, running};
use emulator::registers::rcc::Reset;
use firmware::link::{Command, Refusal};
use firmware::supervisor::{Fault, State};
use rig::plan;

#[test]
fn a_reset_by_the_pin_or_a_brown_out_in_a_run_boots_into_faulted() {
    let Some(image) = image() else { return };
    let resets = [
        (Reset::Pin, Fault::Reset),
        (Reset::BrownOut, Fault::BrownOut),
        (Reset::Software, Fault::Reset),
    ];
    for (reset, fault) in resets {
        let mut board = running(&image, plan::task(20.0));
        let since = board.machine.board().now;
        board.machine.reset(reset).unwrap();
        assert_eq!(cleared_after_ms(&board, since), 0.0, "{reset:?}: its pins float at once");
        assert_eq!(after_ms(&mut board, 100), (Some(fault), State::Faulted));
        println!("{reset:?}: {}", board.query().unwrap().unwrap().fault.unwrap());
        let refused = board.ask(Command::Arm).unwrap();
        assert_eq!(refused, Some(Err(Refusal::NotNow { state: State::Faulted })));
        // Neither another reset nor the power clears it: the flash has it by now.
        board.machine.reset(Reset::Pin).unwrap();
        assert_eq!(after_ms(&mut board, 100), (Some(fault), State::Faulted));
        board.machine.reset(Reset::PowerOn).unwrap();
        assert_eq!(after_ms(&mut board, 100), (Some(fault), State::Faulted));
        done(&mut board, Command::ClearFault);
        board.machine.reset(Reset::Pin).unwrap();
        assert_eq!(after_ms(&mut board, 100), (None, State::Disarmed));
    }
}

#[test]
fn a_reset_of_an_armed_board_is_one_too_and_of_a_disarmed_one_is_none() {
    let Some(image) = image() else { return };
    for (disarms, expected) in
        [(false, (Some(Fault::Reset), State::Faulted)), (true, (None, State::Disarmed))]
    {
        let mut board = running(&image, plan::task(20.0));
        done(&mut board, Command::Stop);
        if disarms {
            done(&mut board, Command::Disarm);
        }
        board.run_ms(5).unwrap();
        board.machine.reset(Reset::Pin).unwrap();
        assert_eq!(after_ms(&mut board, 100), expected);
    }
}

#[test]
fn a_power_on_is_no_fault_whatever_the_memory_has() {
    let Some(image) = image() else { return };
    let mut board = running(&image, plan::task(20.0));
    // The supply was away for so long that the memory has anything.
    board.machine.reset(Reset::PowerOn).unwrap();
    assert_eq!(after_ms(&mut board, 100), (None, State::Disarmed));
    for reset in [Reset::PowerOn, Reset::BrownOut, Reset::Pin] {
        let mut board = board_alone(&image);
        board.run_ms(100).unwrap();
        board.machine.reset(reset).unwrap();
        assert_eq!(after_ms(&mut board, 100), (None, State::Disarmed), "{reset:?}");
    }
}

#[test]
fn what_is_kept_is_not_believed_with_a_bit_flipped() {
    let Some(image) = image() else { return };
    let latch = image.symbol(&["LATCH"]).expect("the memory that a reset leaves alone");
    for bit in [0, 3, 77, 191, 192, 223] {
        let mut board = running(&image, plan::task(20.0));
        let at = latch + bit / 8;
        let byte = board.machine.ram(at, 1)[0];
        board.machine.reset(Reset::BrownOut).unwrap();
        board.machine.set_ram(at, &[byte ^ 1 << (bit % 8)]);
        assert_eq!(after_ms(&mut board, 100), (None, State::Disarmed), "bit {bit}");
    }
}
