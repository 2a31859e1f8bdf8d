//! What the board does when tick, thread, converter or memory fail.
#![allow(missing_docs)]

mod common;

use common::{after_ms, board_alone, cleared_after_ms, commit, done, image, running};
use emulator::operator::Operator;
use emulator::registers::gpio::Pin;
use emulator::registers::rcc::Reset;
use emulator::registers::{MS, US};
use firmware::link::Command;
use firmware::supervisor::{Fault, State};
use model::reference_robot::reference_robot;
use rig::{Rig, plan};

#[test]
fn the_watchdog_bites_when_the_tick_stops() {
    let Some(image) = image() else { return };
    let mut board = running(&image, plan::task(20.0));
    let since = board.machine.board().now;
    // The interrupt of TIM6 is disabled, line 54.
    board.machine.board().nvic.write(0x84, 4, 1 << 22).unwrap();
    assert_eq!(after_ms(&mut board, 100), (Some(Fault::Watchdog), State::Faulted));
    let within_ms = cleared_after_ms(&board, since);
    println!("tick stopped: 0 V after {within_ms} ms");
    assert!(within_ms < 39.0 && board.machine.resets.len() == 1);
    assert_eq!(board.machine.resets[0].0, Reset::Watchdog);
}

#[test]
fn the_watchdog_bites_when_the_thread_hangs() {
    let Some(image) = image() else { return };
    let mut board = running(&image, plan::task(20.0));
    board.machine.hang_thread().unwrap();
    let since = board.machine.board().now;
    assert_eq!(after_ms(&mut board, 100), (Some(Fault::Watchdog), State::Faulted));
    let within_ms = cleared_after_ms(&board, since);
    println!("thread hangs: 0 V after {within_ms} ms");
    assert!(within_ms < 34.0 && board.machine.resets.len() == 1);
    // A reset does not clear it, a host does.
    board.machine.reset(Reset::Pin).unwrap();
    assert_eq!(after_ms(&mut board, 100), (Some(Fault::Watchdog), State::Faulted));
    done(&mut board, Command::ClearFault);
    board.machine.reset(Reset::PowerOn).unwrap();
    assert_eq!(after_ms(&mut board, 100), (None, State::Disarmed));
}

#[test]
fn a_crash_pulls_clr_low_at_once_and_resets_the_board() {
    let Some(image) = image() else { return };
    let mut board = running(&image, plan::task(20.0));
    board.machine.crash_thread().unwrap();
    let since = board.machine.board().now;
    board.run_ms(1).unwrap();
    let within_ms = cleared_after_ms(&board, since);
    println!("crash: 0 V after {within_ms} ms");
    assert!(within_ms < 0.01 && board.machine.board().trace.faults.len() == 1);
    let place = board.machine.board().trace.faults[0].clone();
    assert_eq!(after_ms(&mut board, 100), (Some(Fault::Crash), State::Faulted));
    let told = board.query().unwrap().unwrap().fault.unwrap().to_string();
    println!("told: {told}");
    let counter = place.split(' ').next().unwrap();
    assert!(told.contains(counter) && told.contains("fault status 0x00010000"), "{place}");
    assert_eq!(board.machine.resets.len(), 1);
}

#[test]
fn a_tick_that_comes_late_is_a_fault() {
    let Some(image) = image() else { return };
    let mut board = running(&image, plan::hold(20.0));
    let since = board.machine.board().now;
    board.machine.mask_interrupts(true).unwrap();
    board.machine.run_until(since + 3 * MS).unwrap();
    board.machine.mask_interrupts(false).unwrap();
    assert_eq!(after_ms(&mut board, 20), (Some(Fault::TickOverrun), State::Faulted));
    let within_ms = cleared_after_ms(&board, since);
    println!("tick late by 3 ms: 0 V after {within_ms} ms");
    assert!(within_ms < 5.0 && board.machine.resets.is_empty());
}

/// Pins of port C: what the board is told, and what it tells.
const NOT_PRESSED: usize = 5;
const ENABLE: usize = 6;
const POWER_GOOD: usize = 8;
const BRAKES: usize = 9;

/// Enable of the amplifiers and release of the brakes.
fn drive_outputs(board: &Operator) -> [Pin; 2] {
    [ENABLE, BRAKES].map(|pin| board.machine.board().gpio[2].pin(pin))
}

#[test]
fn an_emergency_stop_and_lost_power_are_seen_at_the_pins() {
    let Some(image) = image() else { return };
    for (pin, fault) in [(NOT_PRESSED, Fault::EmergencyStop), (POWER_GOOD, Fault::DrivePower)] {
        let mut board = running(&image, plan::task(20.0));
        assert_eq!(drive_outputs(&board), [Pin::Output(true); 2]);
        let since = board.machine.board().now;
        board.machine.board().gpio[2].wires &= !(1 << pin);
        assert_eq!(after_ms(&mut board, 5), (Some(fault), State::Faulted));
        let within_ms = cleared_after_ms(&board, since);
        println!("{fault}: 0 V after {within_ms} ms");
        assert!(within_ms < 2.1);
        assert_eq!(drive_outputs(&board), [Pin::Output(false); 2]);
        done(&mut board, Command::ClearFault);
        assert_ne!(board.ask(Command::Arm).unwrap(), Some(Ok(())), "not while it is pressed");
    }
}

#[test]
fn a_converter_without_supply_is_found_while_running_and_set_up_again_when_it_is_back() {
    let Some(image) = image() else { return };
    let mut board = running(&image, plan::task(20.0));
    let since = board.machine.board().now;
    board.machine.board().converter.supply_lost = true;
    assert_eq!(after_ms(&mut board, 100), (Some(Fault::Converter), State::Faulted));
    let within_ms = cleared_after_ms(&board, since);
    println!("supply lost while running: CLR low after {within_ms} ms");
    assert!(within_ms < 65.0);
    assert_ne!(board.ask(Command::ClearFault).unwrap(), Some(Ok(())), "it is still lost");
    board.machine.reset(Reset::Pin).unwrap();
    assert_eq!(after_ms(&mut board, 100), (Some(Fault::Converter), State::Faulted));
    assert_eq!(board.machine.board().converter.volts(), [0.0; 3]);
    board.machine.board().converter.supply_lost = false;
    done(&mut board, Command::ClearFault);
    assert_eq!(after_ms(&mut board, 10), (None, State::Disarmed));
}

/// How often the lamp at PA5 went on in a second.
fn lights(board: &mut Operator) -> usize {
    let mut levels = Vec::new();
    for _ in 0..1000 {
        board.run_ms(1).unwrap();
        levels.push(board.machine.board().gpio[0].pin(5) == Pin::Output(true));
    }
    levels.windows(2).filter(|pair| !pair[0] && pair[1]).count()
}

#[test]
fn a_board_without_its_crystal_uses_its_own_oscillator_and_the_lamp_tells() {
    let Some(image) = image() else { return };
    for (crystal, expected) in [(true, 1), (false, 2)] {
        let mut board = board_alone(&image);
        board.machine.board().rcc.crystal = crystal;
        board.run_ms(300).unwrap();
        assert!(board.hello().unwrap() && !board.machine.board().converter.is_released());
        assert_eq!(lights(&mut board), expected, "disarmed");
    }
}

#[test]
fn a_crystal_that_fails_in_a_run_pulls_clr_low_at_once_and_is_told() {
    let Some(image) = image() else { return };
    let mut board = running(&image, plan::task(20.0));
    let since = board.machine.board().now;
    board.machine.board().fail_crystal();
    board.run_ms(1).unwrap();
    let within_ms = cleared_after_ms(&board, since);
    println!("crystal failed: 0 V after {within_ms} ms");
    assert!(within_ms < 0.01);
    assert_eq!(after_ms(&mut board, 300), (Some(Fault::Crystal), State::Faulted));
    assert_eq!(board.machine.resets.len(), 1);
    // The board goes on from the chip's own oscillator.
    done(&mut board, Command::ClearFault);
    assert_eq!(after_ms(&mut board, 10), (None, State::Disarmed));
}

#[test]
fn a_clock_that_drifts_from_the_watchdogs_is_found_and_stays_a_fault_while_it_does() {
    let Some(image) = image() else { return };
    // What data sheets allow: nothing.
    for clock_hz in [29_500, 34_000] {
        let mut board = running(&image, plan::task(20.0));
        board.machine.board().watchdog.clock_hz = clock_hz;
        assert_eq!(after_ms(&mut board, 500), (None, State::Running));
    }
    // A crystal that goes slower, and one that goes faster, against a clock that goes as before.
    for clock_hz in [28_000, 37_000] {
        let mut board = running(&image, plan::task(20.0));
        let since = board.machine.board().now;
        board.machine.board().watchdog.clock_hz = clock_hz;
        board.run_ms(400).unwrap();
        let within_ms = cleared_after_ms(&board, since);
        println!("the watchdog's clock at {clock_hz} Hz: 0 V after {within_ms:.1} ms");
        assert!(within_ms < 300.0);
        assert_eq!(after_ms(&mut board, 10), (Some(Fault::Clock), State::Faulted));
        assert_ne!(board.ask(Command::ClearFault).unwrap(), Some(Ok(())), "it is still wrong");
        board.machine.board().watchdog.clock_hz = 32_000;
        board.run_ms(400).unwrap();
        done(&mut board, Command::ClearFault);
    }
}

#[test]
fn inputs_of_encoders_have_a_level_where_nothing_is_connected() {
    let Some(image) = image() else { return };
    let mut board = board_alone(&image);
    board.run_ms(50).unwrap();
    let pulls = board.machine.board().gpio[0].pulls();
    for pin in [0, 1, 6, 7, 8, 9] {
        assert_eq!(pulls >> (2 * pin) & 3, 1, "PA{pin} is pulled up");
    }
}

#[test]
fn a_broken_word_of_the_flash_comes_by_the_nmi_and_costs_a_slot_at_most() {
    let Some(image) = image() else { return };
    let mut board = board_alone(&image);
    let rig = Rig::new(reference_robot());
    board.run_ms(50).unwrap();
    commit(&mut board, &plan::task(20.0).block(&rig));
    // The first double words of both slots.
    let bank2 = emulator::memory_map::BANK_BYTES;
    for offset in [64, 4096 + 64] {
        board.machine.board().flash.unreadable.insert(bank2 + offset);
    }
    board.machine.reset(Reset::Pin).unwrap();
    let found = after_ms(&mut board, 100);
    println!("both slots broken: {found:?}");
    assert_eq!(found, (Some(Fault::CorruptParameters), State::Faulted));
    assert!(board.machine.board().trace.faults.is_empty() && board.machine.resets.len() == 1);
    commit_after_clearing(&mut board, &rig);
}

fn commit_after_clearing(board: &mut Operator, rig: &Rig) {
    let _ = board.ask(Command::ClearFault).unwrap();
    commit(board, &plan::task(20.0).block(rig));
    board.machine.reset(Reset::Pin).unwrap();
    assert_eq!(after_ms(board, 100), (None, State::Disarmed));
}

#[test]
fn the_slowest_erase_does_not_wake_the_fastest_watchdog() {
    let Some(image) = image() else { return };
    let mut board = board_alone(&image);
    let rig = Rig::new(reference_robot());
    // The extremes of the data sheet, over temperature and supply.
    board.machine.board().watchdog.clock_hz = 34_000;
    board.machine.board().flash.erase = 24_500 * US;
    board.run_ms(50).unwrap();
    for seconds in [10.0, 20.0, 30.0, 40.0] {
        commit(&mut board, &plan::task(seconds).block(&rig));
        assert_eq!(board.machine.resets, []);
    }
    let longest_ms = board.machine.board().watchdog.longest as f64 / MS as f64;
    println!("reloaded after {longest_ms} ms at the latest");
}
