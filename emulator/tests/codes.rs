//! The image's codes at the converter are those of the library on this machine, bit for bit.
#![allow(missing_docs)]

mod common;

use std::rc::Rc;

use common::{
    attend, board_with_arm, commit, home_and_run, image, rig_that_compensates, told, wired,
};
use emulator::handler::Handler;
use emulator::image::Image;
use emulator::operator::Operator;
use emulator::registers::US;
use emulator::registers::rcc::Reset;
use emulator::replica::Replica;
use firmware::{Mode, ParameterBlock};
use model::reference_robot::reference_robot;
use rig::{Rig, plan};
use simulation::start_of;

/// Seconds of the motion; `RRR_SOAK` has a minute of it.
fn seconds() -> u64 {
    if std::env::var_os("RRR_SOAK").is_some() { 60 } else { 4 }
}

/// A board that has played a block for so long, from a boot with that block.
fn played(image: &Rc<Image>, block: &ParameterBlock, seconds: u64) -> Operator {
    let start = start_of(block);
    let mut board = board_with_arm(image, start);
    board.run_ms(100).unwrap();
    commit(&mut board, block);
    // The same flash, and no parameters replaced since the boot.
    board.machine.reset(Reset::Pin).unwrap();
    board.machine.board().trace.ticks.clear();
    board.telemetry.clear();
    home_and_run(&mut board, start);
    board.machine.board().trace.handler = Handler::default();
    attend(&mut board, seconds);
    // What a question took, or less, so that there are as many ticks.
    board.run_ms(2 * seconds).unwrap();
    assert_eq!(board.strange, 0);
    board
}

/// Compares all of its ticks with the library's.
fn assert_same_codes(board: &Operator, block: &ParameterBlock, seconds: u64) {
    let machine = board.machine.board();
    let replica = Replica::new(&machine.flash.bytes, told(start_of(block)));
    let comparison = replica.compare(&machine.trace.ticks, &board.telemetry);
    println!("{comparison:?}");
    assert_eq!(comparison.first, None);
    assert!(comparison.running as u64 > 1000 * seconds - 100, "{comparison:?}");
}

/// What the ticks took, for the figures of `docs/emulator.md`.
fn tell(board: &Operator) {
    let machine = board.machine.board();
    let latencies = machine.trace.ticks.iter().filter_map(|tick| tick.latency);
    let (least, most) = latencies.fold((u64::MAX, 0), |(a, b), x| (a.min(x), b.max(x)));
    println!("timer to LDAC: {least} to {most} cycles");
    let handler = &machine.trace.handler;
    let mean = handler.instructions / handler.runs;
    println!("the tick: {mean} instructions on average, at most {:?}", handler.most);
    println!("of {} instructions {} fetched a line", machine.instructions, machine.cost.misses);
    println!("watchdog reloaded every {} us at least", machine.watchdog.longest / US);
}

#[test]
fn the_validation_motion_is_played_bit_for_bit() {
    let Some(image) = image() else { return };
    let rig = Rig::new(reference_robot());
    let block = plan::task(60.0).with_mode(Mode::PdModel).block(&rig);
    let board = played(&image, &block, seconds());
    assert_same_codes(&board, &block, seconds());
    tell(&board);
    let (deepest, stack) = (board.machine.deepest, board.machine.stack_bytes());
    println!("{deepest} exceptions at once, {stack} bytes of stack");
    println!("{} frames with floating-point registers", board.machine.floating_frames);
    assert!(board.machine.floating_frames > 0);
    assert!(stack <= 64 << 10, "twice as much would meet the variables");
}

#[test]
fn with_every_compensation_on_the_codes_are_the_same() {
    let Some(image) = image() else { return };
    let block = plan::task(60.0).with_mode(Mode::PdModel).block(&rig_that_compensates());
    let seconds = seconds() / 2;
    let board = played(&image, &block, seconds);
    assert_same_codes(&board, &block, seconds);
    tell(&board);
}

#[test]
fn where_outputs_are_measured_the_codes_are_the_same() {
    let Some(image) = wired() else { return };
    let block = plan::task(60.0).with_mode(Mode::PdModel).block(&Rig::new(reference_robot()));
    let board = played(&image, &block, 2);
    assert!(board.machine.board().adc.waits_for_timer());
    assert_same_codes(&board, &block, 2);
    tell(&board);
}
