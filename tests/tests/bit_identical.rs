//! Host and Cortex-M4F compute the same codes, bit for bit.
#![allow(missing_docs)]

use firmware::Mode;
use host_tool::board::{Board, InProcess};
use host_tool::simulation::sensor::counts;
use host_tool::simulation::{Settings, SimulatedRobot};
use tests::{image, minute_of, qemu, rig};

#[test]
fn a_minute_in_every_mode_gives_the_same_codes_on_both() {
    let Some(image) = image() else { return };
    let mut on_board = qemu(&image);
    let rig = rig();
    for mode in Mode::ALL {
        let block = minute_of(&rig, mode);
        let mut on_host = InProcess::default();
        for board in [&mut on_board as &mut dyn Board, &mut on_host] {
            board.load(&block).unwrap();
            board.start().unwrap();
        }
        let start = [0.0, -std::f64::consts::FRAC_PI_2, 0.0];
        let mut robot = SimulatedRobot::at_rest(rig.model, start, &Settings::default());
        let mut moved = false;
        for tick in 0..60_000 {
            let seen = counts(robot.q_rad(), rig.encoder_counts_per_turn).map(|c| c as i32);
            let (board, host) = (on_board.tick(&seen).unwrap(), on_host.tick(&seen).unwrap());
            assert_eq!(board.codes, host.codes, "{} at tick {tick}", mode.name());
            assert_eq!(board.reference, host.reference, "{} at tick {tick}", mode.name());
            moved |= robot.qd_rad_per_s().iter().all(|qd| qd.abs() > 0.01);
            robot.advance(&board.codes.map(|code| f64::from(code.to_volts())));
        }
        assert!(moved, "the arm moved in mode {}", mode.name());
    }
}
