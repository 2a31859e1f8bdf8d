//! The image's codes at the converter are those of the library on this machine, bit for bit.
#![allow(missing_docs)]

mod common;

use common::{board_with_arm, commit, home_and_run, image, told};
use emulator::registers::US;
use emulator::registers::rcc::Reset;
use emulator::replica::Replica;
use emulator::trace::Handler;
use firmware::Mode;
use model::reference_robot::reference_robot;
use rig::{Rig, plan};
use simulation::start_of;

/// Seconds of the motion; `RRR_SOAK` has a minute of it.
fn seconds() -> u64 {
    if std::env::var_os("RRR_SOAK").is_some() { 60 } else { 4 }
}

#[test]
fn the_validation_motion_is_played_bit_for_bit() {
    let Some(image) = image() else { return };
    let rig = Rig::new(reference_robot());
    let block = plan::task(60.0).with_mode(Mode::PdModel).block(&rig);
    let start = start_of(&block);
    let mut board = board_with_arm(&image, start);
    board.run_ms(100).unwrap();
    commit(&mut board, &block);
    // The same flash, and no parameters replaced since the boot.
    board.machine.reset(Reset::Pin).unwrap();
    board.machine.board().trace.ticks.clear();
    board.telemetry.clear();
    home_and_run(&mut board, start);
    board.machine.board().trace.handler = Handler::default();
    board.run_ms(1000 * seconds()).unwrap();

    let machine = board.machine.board();
    let replica = Replica::new(&machine.flash.bytes, told(start));
    let comparison = replica.compare(&machine.trace.ticks, &board.telemetry);
    println!("{comparison:?}");
    assert_eq!(comparison.first, None);
    assert!(comparison.running as u64 > 1000 * seconds() - 100, "{comparison:?}");
    let latencies = machine.trace.ticks.iter().filter_map(|tick| tick.latency);
    let (least, most) = latencies.fold((u64::MAX, 0), |(a, b), x| (a.min(x), b.max(x)));
    println!("timer to LDAC: {least} to {most} cycles");
    let handler = machine.trace.handler;
    let mean = handler.instructions / handler.runs;
    println!("instructions of the tick: {mean} on average, {handler:?}");
    println!(
        "cache lines fetched: {}, instructions: {}",
        machine.cost.misses, machine.instructions
    );
    println!(
        "longest time between two reloads of the watchdog: {} us",
        machine.watchdog.longest / US
    );
    drop(machine);
    let (deepest, stack) = (board.machine.deepest, board.machine.stack_bytes());
    println!("{deepest} exceptions at once, {stack} bytes of stack");
    assert!(stack <= 64 << 10, "twice as much would meet the variables");
    assert_eq!(board.strange, 0);
}
