//! Host and Cortex-M4F compute the same codes, bit for bit.
#![allow(missing_docs)]

use firmware::Mode;
use rig::Rig;
use rig::effects::Effect;
use simulation::board::{Board, InProcess, Qemu};
use simulation::sensor::counts;
use simulation::{Settings, SimulatedRobot};
use tests::{every_kind_of_effect, image, minute_of, qemu, rig, rig_that_compensates, simulated};

/// Drives both boards with what one of them does to a robot, for so many ticks.
fn assert_same_codes(
    on_board: &mut Qemu,
    rig: &Rig,
    mode: Mode,
    effects: Vec<Box<dyn Effect>>,
    ticks: u32,
) {
    let block = minute_of(rig, mode);
    let mut on_host = InProcess::default();
    for board in [on_board as &mut dyn Board, &mut on_host] {
        board.load(&block).unwrap();
        board.start().unwrap();
    }
    let start = [0.0, -std::f64::consts::FRAC_PI_2, 0.0];
    let mut robot = SimulatedRobot::with_effects(rig.model, effects, start, &Settings::default());
    let mut moved = false;
    for tick in 0..ticks {
        let seen = counts(robot.q_rad(), rig.encoder_counts_per_turn).map(|c| c as i32);
        let (board, host) = (on_board.tick(&seen).unwrap(), on_host.tick(&seen).unwrap());
        assert_eq!(board.codes, host.codes, "{} at tick {tick}", mode.name());
        assert_eq!(board.reference, host.reference, "{} at tick {tick}", mode.name());
        moved |= robot.qd_rad_per_s().iter().all(|qd| qd.abs() > 0.01);
        robot.advance(&board.codes.map(|code| f64::from(code.to_volts())));
    }
    assert!(moved, "the arm moved in mode {}", mode.name());
}

#[test]
fn a_minute_in_every_mode_gives_the_same_codes_on_both() {
    let Some(image) = image() else { return };
    let mut on_board = qemu(&image);
    for mode in Mode::ALL {
        assert_same_codes(&mut on_board, &rig(), mode, Vec::new(), 60_000);
    }
}

#[test]
fn compensations_of_every_kind_give_the_same_codes_on_both() {
    let Some(image) = image() else { return };
    let mut on_board = qemu(&image);
    let effects = every_kind_of_effect();
    let rig = rig_that_compensates(&effects);
    for mode in [Mode::PdFriction, Mode::PdModel, Mode::FrictionOnly] {
        assert_same_codes(&mut on_board, &rig, mode, simulated(&effects), 60_000);
    }
}
