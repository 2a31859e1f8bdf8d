//! The command handler among hosts that are gone, foreign or hostile, and flash that fails.
#![allow(missing_docs)]

#[allow(dead_code)]
mod bench;
#[allow(dead_code)]
mod common;

use bench::operator::{Bench, Owned, encoded, frame, read_answer};
use firmware::link::{Command, MAX_FRAME_BYTES, Refusal, Request, StoreRefusal, ToBoard};
use firmware::reference::Reference;
use firmware::supervisor::{Fault, Health, State};
use firmware::{Angle, Mode, ParameterBlock};

const KEY: [u8; 32] = [0x5A; 32];
const RUN: Command<'_> = Command::Run { host_timeout_ms: Some(100) };

/// A board that runs, with a host that must be heard.
fn running(key: Option<[u8; 32]>) -> Bench {
    let mut bench = Bench::new(key);
    let reference = Reference::hold([0.0; 3]);
    let block = ParameterBlock { reference, ..common::block(Mode::Pd) };
    bench.upload(&encoded(&block), Command::Use).unwrap();
    bench.stand(200);
    bench.ask(Command::Arm).unwrap();
    bench.ask(RUN).unwrap();
    bench
}

/// From the silence of a host to 0 V: a second to brake at most, and one to hold.
const CONTROLLED_STOP_TICKS: u32 = 2001;

#[test]
fn stop_and_disarm_are_executed_under_any_number() {
    for (command, state) in [(Command::Stop, State::Armed), (Command::Disarm, State::Disarmed)] {
        let mut bench = running(Some(KEY));
        // Somebody without the key has used up the numbers.
        let last = Request { number: u32::MAX, proof: None, command: RUN };
        assert_eq!(read_answer(&bench.send(&frame(last))[0]).1, Err(Refusal::Proof));
        let late = Request { number: 3, proof: None, command };
        assert_eq!(read_answer(&bench.send(&frame(late))[0]), (3, Ok(Owned::Done)));
        assert_eq!(bench.supervisor.state(), state);
        let again = Request { number: 4, proof: None, command: Command::ClearFault };
        let refused = read_answer(&bench.send(&frame(again))[0]).1;
        assert_eq!(refused, Err(Refusal::OldNumber { newest: u32::MAX }), "nothing else is");
    }
}

#[test]
fn a_host_is_heard_by_what_the_board_carries_out() {
    let old = frame(Request { number: 1, proof: None, command: Command::Query });
    let unproven = |number| frame(Request { number, proof: None, command: Command::ClearFault });
    let hello = ToBoard::Hello { protocol_version: 1 };
    let hello = hello.write(&mut [0; MAX_FRAME_BYTES]).unwrap().to_vec();
    for noise in [vec![old], (1000..1400).map(unproven).collect(), vec![hello]] {
        let mut bench = running(Some(KEY));
        for tick in 0..150 {
            bench.send(&noise[tick % noise.len()]);
            bench.stand(1);
        }
        let found = bench.supervisor.fault().map(|record| record.fault);
        assert_eq!(found, Some(Fault::LinkLost));
    }
    let mut bench = running(Some(KEY));
    for _ in 0..10 {
        bench.report();
        bench.stand(50);
    }
    assert_eq!(bench.supervisor.state(), State::Running);
}

#[test]
fn a_flash_that_does_not_keep_a_fault_is_not_worn_out_by_it() {
    let mut bench = running(None);
    bench.handler.store().fails = true;
    for _ in 0..102 {
        bench.supervisor.tick(&[0; 3], Health::default());
    }
    let tried = (0..100).filter(|_| bench.handler.store_fault(&bench.supervisor)).count();
    assert_eq!(tried, 0);
    bench.handler.store().fails = false;
    assert!(!bench.handler.store_fault(&bench.supervisor), "three failures are enough");
    for _ in 0..CONTROLLED_STOP_TICKS {
        bench.supervisor.tick(&[0; 3], Health::default());
    }
    bench.ask(Command::ClearFault).unwrap();
    assert_eq!(bench.handler.store().fault, None);
}

#[test]
fn a_fault_that_is_cleared_but_not_in_the_flash_is_told() {
    let mut bench = running(None);
    bench.stand(102);
    assert!(bench.handler.store_fault(&bench.supervisor), "while it brakes");
    bench.stand(CONTROLLED_STOP_TICKS);
    bench.handler.store().fails = true;
    let refused = bench.ask(Command::ClearFault);
    assert_eq!(refused, Err(Refusal::Store(StoreRefusal::Write)));
    assert!(bench.handler.store().fault.is_some(), "latched again after a reset");
}

#[test]
fn home_is_told_over_the_line_with_the_key_and_disarmed() {
    let position = [0.1, -1.5, 0.0].map(Angle::from_radians);
    let mut bench = running(Some(KEY));
    let running_refuses = bench.ask(Command::Home { position });
    assert_eq!(running_refuses, Err(Refusal::NotNow { state: State::Running }));
    bench.ask(Command::Disarm).unwrap();
    assert_eq!(bench.ask(Command::Home { position }), Ok(Owned::Done));
    bench.stand(200);
    let counts = bench.supervisor.tick(&[0; 3], Default::default()).counts;
    assert_eq!(counts, [10_430, -156_456, 0]);
    bench.key = None;
    assert_eq!(bench.ask(Command::Home { position }), Err(Refusal::Proof));
}
