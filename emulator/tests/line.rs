//! The serial line under load, and interrupts inside interrupts.
#![allow(missing_docs)]

mod common;

use common::{board_alone, board_with_arm, commit, done, home_and_run, image, told};
use emulator::memory_map::BANK_BYTES;
use emulator::operator::Operator;
use emulator::registers::MS;
use emulator::registers::rcc::Reset;
use emulator::replica::{Comparison, Replica};
use firmware::Mode;
use firmware::link::Command;
use model::reference_robot::reference_robot;
use rig::{Rig, plan};
use simulation::start_of;

/// Knuth's linear congruential generator.
struct Draw(u64);

impl Draw {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % limit
    }
}

/// Requests, or milliseconds, of each test.
fn rounds() -> u64 {
    if std::env::var_os("RRR_SOAK").is_some() { 20_000 } else { 1000 }
}

#[test]
fn a_request_at_any_instant_is_answered_while_telemetry_flows() {
    let Some(image) = image() else { return };
    let mut board = board_alone(&image);
    board.run_ms(50).unwrap();
    assert!(board.hello().unwrap());
    done(&mut board, Command::Stream { on: true });
    let mut draw = Draw(1);
    for request in 0..rounds() {
        let end = board.machine.board().now + draw.below(600_000);
        board.machine.run_until(end).unwrap();
        assert_eq!(board.ask(Command::Query).unwrap(), Some(Ok(())), "request {request}");
    }
    let board = board.machine.board();
    assert_eq!((board.lpuart.overruns, board.trace.faults.len()), (0, 0));
}

/// A board in the first tick of the task, booted with its block.
fn at_task(image: &std::rc::Rc<emulator::image::Image>) -> (Operator, [f64; 3]) {
    let rig = Rig::new(reference_robot());
    let block = plan::task(60.0).with_mode(Mode::PdModel).block(&rig);
    let start = start_of(&block);
    let mut board = board_with_arm(image, start);
    board.run_ms(50).unwrap();
    commit(&mut board, &block);
    board.machine.reset(Reset::Pin).unwrap();
    board.machine.board().trace.ticks.clear();
    board.telemetry.clear();
    home_and_run(&mut board, start);
    (board, start)
}

fn compared(board: &Operator, start: [f64; 3]) -> Comparison {
    let machine = board.machine.board();
    Replica::new(&machine.flash.bytes, told(start)).compare(&machine.trace.ticks, &board.telemetry)
}

#[test]
fn a_flood_on_the_line_changes_no_code_and_breaks_nothing() {
    let Some(image) = image() else { return };
    let (mut board, start) = at_task(&image);
    let mut draw = Draw(2);
    for round in 0..rounds() {
        if round % 1000 == 999 {
            // The host's sign of life, behind the zero that ends what the noise has begun.
            board.send(&[0]);
            let _ = board.query().unwrap();
        }
        // More than the line carries in a millisecond, zeros that end frames among it.
        let noise: Vec<u8> = (0..93).map(|_| (draw.below(280) % 256) as u8).collect();
        board.send(&noise);
        board.run_ms(1).unwrap();
    }
    board.machine.board().lpuart.incoming.clear();
    board.send(&[0]);
    assert!(board.hello().unwrap(), "it answers after the flood");
    let report = board.query().unwrap().unwrap();
    println!("flood: {:?}", report.counters);
    assert!(report.counters.frames_broken > 20 && report.fault.is_none());
    let comparison = compared(&board, start);
    assert_eq!(comparison.first, None);
    assert!(comparison.running as u64 >= rounds());
    assert!(board.machine.deepest >= 2, "the tick came into the middle of other interrupts");
    assert!(board.machine.resets.len() == 1, "but for the test's own");
}

#[test]
fn an_nmi_in_the_middle_of_a_tick_in_the_middle_of_an_interrupt_changes_no_code() {
    let Some(image) = image() else { return };
    let (mut board, start) = at_task(&image);
    let mut draw = Draw(3);
    let mut nested = 0;
    // The reference lasts for 60 s, and holding after it for 30 s at most.
    let end_of_run = board.machine.board().now + 80_000 * MS;
    for round in 0..rounds() / 4 {
        if board.machine.board().now > end_of_run {
            break;
        }
        if round % 50 == 49 {
            board.send(&[0]);
            let _ = board.query().unwrap();
        }
        board.send(&[round as u8 + 1; 40]);
        // Into the tick, or with luck a tick inside another interrupt, and some way on.
        let depth = if round % 2 == 0 { 1 } else { 2 };
        if board.machine.run_to_depth(depth).unwrap() {
            let end = board.machine.board().now + draw.below(2500);
            board.machine.run_until(end).unwrap();
            nested += u32::from(board.machine.board().nvic.depth() == depth);
            let mut machine = board.machine.board();
            machine.flash.unreadable.insert(BANK_BYTES + 200_000);
            let now = machine.now;
            machine.flash.read_bank2(200_000, 4, now);
            machine.set_lines();
        }
        board.run_ms(7).unwrap();
    }
    println!("{nested} within handlers, {} deep at most", board.machine.deepest);
    assert!(nested > 10 && board.machine.deepest >= 3);
    assert_eq!(compared(&board, start).first, None);
    assert_eq!(board.machine.resets.len(), 1);
}
