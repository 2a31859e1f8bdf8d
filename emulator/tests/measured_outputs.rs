//! The converter's outputs, measured by ADC1 where the rig has the dividers.
#![allow(missing_docs)]

mod common;

use common::{after_ms, attend, done, image, running, wired};
use emulator::operator::Operator;
use emulator::registers::MS;
use emulator::registers::gpio::Pin;
use firmware::link::Command;
use firmware::supervisor::{Fault, State};
use rig::plan;

/// Enable of the amplifiers, at port C.
const ENABLE: usize = 6;

/// Milliseconds from now until the amplifiers are disabled.
fn disabled_after_ms(board: &mut Operator, at_most_ms: u64) -> Option<f64> {
    let since = board.machine.board().now;
    for _ in 0..at_most_ms * 20 {
        let now = board.machine.board().now;
        board.machine.run_until(now + MS / 20).unwrap();
        if board.machine.board().gpio[2].pin(ENABLE) == Pin::Output(false) {
            return Some((board.machine.board().now - since) as f64 / MS as f64);
        }
    }
    None
}

#[test]
fn the_adc_is_touched_where_it_is_wired_alone_and_right_outputs_are_no_fault() {
    let (Some(image), Some(wired)) = (image(), wired()) else { return };
    for (image, measures) in [(image, false), (wired, true)] {
        let mut board = running(&image, plan::task(20.0));
        attend(&mut board, 2);
        done(&mut board, Command::Stop);
        // Armed and at 0 V, the measured outputs are those of CLR.
        assert_eq!(after_ms(&mut board, 500), (None, State::Armed));
        assert_eq!(board.machine.board().adc.waits_for_timer(), measures);
    }
}

#[test]
fn an_output_that_is_not_what_its_code_says_is_found_where_it_is_measured() {
    let Some(image) = wired() else { return };
    for (joint, sticks_at_v) in [(1, 9.0), (2, -9.0), (3, 2.5)] {
        let mut board = running(&image, plan::hold(20.0));
        board.machine.board().converter.sticks_at_v[joint - 1] = Some(sticks_at_v);
        let within_ms = disabled_after_ms(&mut board, 20).expect("the amplifiers go off");
        assert!(!board.machine.board().converter.is_released());
        assert_eq!(after_ms(&mut board, 5), (Some(Fault::OutputVoltage), State::Faulted));
        let record = board.query().unwrap().unwrap().fault.unwrap();
        println!("output {joint} at {sticks_at_v} V: off after {within_ms} ms: {record}");
        assert!(within_ms < 5.1, "{within_ms}");
        assert_eq!(usize::from(record.joint), joint);
        // It sticks on, beyond CLR: nobody can arm for longer than it takes to find it again.
        done(&mut board, Command::ClearFault);
        board.run_ms(200).unwrap();
        let _ = board.ask(Command::Arm).unwrap();
        let (fault, state) = after_ms(&mut board, 10);
        assert_ne!(state, State::Armed, "{fault:?}");
    }
}

#[test]
fn an_output_that_sticks_where_it_is_is_found_once_its_code_is_elsewhere() {
    let Some(image) = wired() else { return };
    let mut board = running(&image, plan::task(20.0));
    let at_v = board.machine.board().converter.volts()[1];
    board.machine.board().converter.sticks_at_v[1] = Some(at_v);
    let within_ms = disabled_after_ms(&mut board, 2000).expect("the amplifiers go off");
    assert_eq!(after_ms(&mut board, 5), (Some(Fault::OutputVoltage), State::Faulted));
    println!("{}, after {within_ms} ms", board.query().unwrap().unwrap().fault.unwrap());
}

#[test]
fn without_the_dividers_such_an_output_is_seen_by_the_arm_alone() {
    let Some(image) = image() else { return };
    let mut board = running(&image, plan::hold(20.0));
    board.machine.board().converter.sticks_at_v[1] = Some(9.0);
    let (fault, state) = after_ms(&mut board, 1000);
    println!("not measured: {fault:?}");
    assert!(state == State::Faulted && fault != Some(Fault::OutputVoltage));
}
