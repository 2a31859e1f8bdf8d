//! Instructions of a tick on the Cortex-M4F, counted exactly by QEMU.
#![allow(missing_docs)]

use files::EffectTable;
use firmware::compensation::{
    AngularHarmonic, Compensations, ExternalLoad, Feedforward, InputInverse, MAX_FEEDFORWARD,
    MAX_INPUT_INVERSES,
};
use firmware::{Angle, Mode, ParameterBlock};
use model::effects::Tilt;
use simulation::board::{Board, Qemu};
use simulation::{Settings, SimulatedRobot, record, record_robot, start_of};
use tests::{
    every_reference, full_tables, hidden_effects, image, minute_of, qemu, rig,
    rig_that_compensates, simulated,
};

/// From counts in to codes out, whatever the board plays, the next tick's part prepared.
const MOST_INSTRUCTIONS: f64 = 700.0;
/// On the motion (20)-(21) with all terms on, on average.
const AIM: f64 = 450.0;
/// In the mode that compensates the friction of the measured motion, which nothing can prepare.
const MOST_OF_MEASURED_FRICTION: f64 = 1000.0;

fn instructions(timer_counts: u32) -> f64 {
    f64::from(timer_counts) / 25.6
}

#[test]
fn no_reference_makes_a_tick_too_long() {
    let Some(image) = image() else { return };
    let (mut board, rig) = (qemu(&image), rig());
    println!("{:24} {:>8} {:>8}", "reference", "mean", "worst");
    for plan in every_reference(&rig) {
        let ticks = plan.ticks(&rig).min(20_000);
        let block = plan.block(&rig);
        let recording =
            record(&mut board, &block, &rig.model, &Settings::default(), ticks, &mut |_| {})
                .unwrap();
        let worst = recording.timer_counts.iter().copied().max().map_or(0.0, instructions);
        let mean = recording.instructions_per_tick();
        println!("{:24} {mean:8.0} {worst:8.0}", plan.name);
        assert!(worst > 300.0, "the timer counts");
        assert!(worst < MOST_INSTRUCTIONS, "{}: {worst}", plan.name);
        assert!(plan.name != "task" || mean < AIM, "{mean}");
    }
}

/// Plays every reference on a robot with effects that the board compensates; returns the longest
/// tick [instructions].
fn longest_tick(board: &mut Qemu, title: &str, effects: &[EffectTable]) -> f64 {
    let (rig, mut longest) = (rig_that_compensates(effects), 0.0_f64);
    println!("{title:24} {:>8} {:>8}", "mean", "worst");
    for plan in every_reference(&rig) {
        let ticks = plan.ticks(&rig).min(20_000);
        let block = plan.block(&rig);
        let (effects, settings) = (simulated(effects), Settings::default());
        let robot = SimulatedRobot::with_effects(rig.model, effects, start_of(&block), &settings);
        let recording = record_robot(board, &block, robot, ticks, &mut |_| {}).unwrap();
        let worst = recording.timer_counts.iter().copied().max().map_or(0.0, instructions);
        println!("{:24} {:8.0} {worst:8.0}", plan.name, recording.instructions_per_tick());
        longest = longest.max(worst);
    }
    longest
}

#[test]
fn eight_compensations_make_no_tick_too_long() {
    let Some(image) = image() else { return };
    let worst = longest_tick(&mut qemu(&image), "eight compensations", &hidden_effects());
    assert!(worst < MOST_INSTRUCTIONS, "{worst}");
}

#[test]
fn a_full_table_on_each_joint_makes_no_tick_too_long() {
    let Some(image) = image() else { return };
    let worst = longest_tick(&mut qemu(&image), "one table a joint", &full_tables(1));
    assert!(worst < MOST_INSTRUCTIONS, "{worst}");
    longest_tick(&mut qemu(&image), "two tables a joint", &full_tables(2));
}

/// As many compensations as a block can hold, tables left out, each with a wave over the turn.
fn full_block() -> ParameterBlock {
    let wave = AngularHarmonic { order: 7, phase: Angle(1 << 29) };
    let fed_forward = Feedforward::PositionFriction { relative_amplitude: 0.01, wave };
    let undone = InputInverse::TorqueRipple { relative_amplitude: 0.01, wave };
    let full = || Compensations {
        feedforward: [fed_forward; MAX_FEEDFORWARD].into_iter().collect(),
        input_inverses: [undone; MAX_INPUT_INVERSES].into_iter().collect(),
        tables: Default::default(),
    };
    ParameterBlock {
        compensations: [full(), full(), full()],
        external_load: Some(ExternalLoad {
            tilt: Tilt::new(0.01, 0.01, [0.1; 2]),
            tip_force_n: [1.0; 3],
        }),
        ..minute_of(&rig(), Mode::PdModel)
    }
}

#[test]
fn a_full_block_delays_no_code() {
    let Some(image) = image() else { return };
    let mut board = qemu(&image);
    board.load(&full_block()).unwrap();
    board.start().unwrap();
    let ticks = (0..5000).map(|k| board.tick(&[7 * k, -5 * k, 3 * k]).unwrap().timer_counts);
    let worst = ticks.max().map_or(0.0, instructions);
    println!("{:24} {worst:8.0}", "full block");
    assert!(worst < MOST_INSTRUCTIONS, "{worst}");
}

#[test]
fn a_full_block_with_tables_delays_no_code() {
    let Some(image) = image() else { return };
    let (mut board, mut block) = (qemu(&image), full_block());
    let of_tables = rig_that_compensates(&full_tables(2)).compensations.joints;
    for (joint, with_tables) in block.compensations.iter_mut().zip(of_tables) {
        joint.tables = with_tables.tables;
    }
    board.load(&block).unwrap();
    board.start().unwrap();
    let ticks = (0..5000).map(|k| board.tick(&[7 * k, -5 * k, 3 * k]).unwrap().timer_counts);
    let worst = ticks.max().map_or(0.0, instructions);
    println!("{:24} {worst:8.0}", "full block with tables");
    assert!(worst < MOST_INSTRUCTIONS, "{worst}");
}

#[test]
fn no_mode_makes_a_tick_too_long() {
    let Some(image) = image() else { return };
    let (mut board, rig) = (qemu(&image), rig());
    println!("{:24} {:>8}", "mode", "worst");
    for mode in Mode::ALL {
        board.load(&minute_of(&rig, mode)).unwrap();
        board.start().unwrap();
        let ticks = (0..5000).map(|k| board.tick(&[7 * k, -5 * k, 3 * k]).unwrap().timer_counts);
        let worst = ticks.max().map_or(0.0, instructions);
        println!("{:24} {worst:8.0}", mode.name());
        let most = match mode {
            Mode::FrictionOnly => MOST_OF_MEASURED_FRICTION,
            _ => MOST_INSTRUCTIONS,
        };
        assert!(worst < most, "{}: {worst}", mode.name());
    }
}
