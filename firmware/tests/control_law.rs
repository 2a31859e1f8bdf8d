//! The control law, mode by mode.
#![allow(missing_docs)]

mod common;

use common::block;
use firmware::dac::VOLTS_PER_LSB;
use firmware::reference::{Injection, Motion, Noise, Reference};
use firmware::{Controller, DacCode, Mode, ParameterBlock};
use model::reference_robot::reference_robot;
use model::{FrictionState, Posture};

/// A rig that holds the level arm, where gravity asks for most.
fn holding(mode: Mode) -> ParameterBlock {
    ParameterBlock { reference: Reference::hold([0.0; 3]), ..block(mode) }
}

fn started(block: ParameterBlock) -> Controller {
    block.check().unwrap();
    let mut controller = Controller::new(block);
    controller.start();
    controller
}

fn volts(codes: [DacCode; 3]) -> [f32; 3] {
    codes.map(DacCode::to_volts)
}

fn assert_near(found: [f32; 3], expected: [f32; 3]) {
    for i in 0..3 {
        assert!((found[i] - expected[i]).abs() <= VOLTS_PER_LSB, "{found:?} {expected:?}");
    }
}

#[test]
fn before_the_start_and_after_the_stop_the_output_is_zero() {
    let mut controller = Controller::new(holding(Mode::PdModel));
    assert_eq!(controller.tick(&[1000; 3]).codes, [DacCode(0); 3]);
    controller.start();
    assert_ne!(controller.tick(&[1000; 3]).codes, [DacCode(0); 3]);
    controller.stop();
    assert_eq!(controller.tick(&[1000; 3]).codes, [DacCode(0); 3]);
}

#[test]
fn feedback_alone_is_equation_17() {
    let mut controller = started(holding(Mode::Pd));
    let error_rad = 100.0 * core::f32::consts::TAU / 655_360.0;
    let found = volts(controller.tick(&[100, -100, 0]).codes);
    assert_near(found, [-80.0 * error_rad, 80.0 * error_rad, 0.0]);
}

#[test]
fn the_model_holds_the_arm_against_gravity() {
    let mut controller = started(holding(Mode::PdModel));
    let robot = reference_robot::<f32>();
    let gravity = Posture::new(0.0, 0.0).gravity(&robot.base, &robot.geometry);
    assert_near(volts(controller.tick(&[0; 3]).codes), robot.torque_to_voltage(&gravity));
}

#[test]
fn friction_mode_adds_the_friction_of_the_reference() {
    let legs = |mode| {
        let mut block = holding(mode);
        block.reference.motion[0] = Motion::Quintic { from_rad: 0.0, to_rad: 0.1, duration_s: 1.0 };
        let mut controller = started(block);
        (0..300).map(|_| volts(controller.tick(&[0; 3]).codes)[0]).last().unwrap()
    };
    let velocity = 3.0 * (0.2995_f32 * 0.7005).powi(2);
    let expected = reference_robot::<f32>().friction[0].sliding(velocity);
    let added = legs(Mode::PdFriction) - legs(Mode::Pd);
    assert!((added - expected).abs() < 0.01 * expected, "{added} {expected}");
}

#[test]
fn friction_alone_follows_the_measured_motion() {
    let mut controller = started(holding(Mode::FrictionOnly));
    let friction = reference_robot::<f32>().friction[1];
    // 0.1 rad/s in counts of joint 2, for a second.
    let count = |tick: i32| (f64::from(tick) * 1e-4 / std::f64::consts::TAU * 655_360.0) as i32;
    let found = (0..1000).map(|k| volts(controller.tick(&[0, count(k), 0]).codes)).last().unwrap();
    let mut state = FrictionState::default();
    let expected = (0..1000).map(|_| state.step(&friction, 0.1, 1e-3)).last().unwrap();
    assert!((found[1] - expected).abs() < 1e-3, "{} {expected}", found[1]);
    assert_eq!(found[0], 0.0);
}

#[test]
fn open_loop_is_the_injected_voltage_alone() {
    let mut block = holding(Mode::OpenLoop);
    let noise = Noise { rms_v: 0.05, bandwidth_hz: 200.0, seed: 4 };
    block.reference.injection[2] = Injection::Noise(noise);
    let mut controller = started(block);
    let commands: Vec<[f32; 3]> =
        (0..20_000).map(|k| volts(controller.tick(&[k, -k, k]).codes)).collect();
    let rms = |i: usize| {
        (commands.iter().map(|u| u[i] * u[i]).sum::<f32>() / commands.len() as f32).sqrt()
    };
    assert_eq!((rms(0), rms(1)), (0.0, 0.0));
    assert!((rms(2) / 0.05 - 1.0).abs() < 0.05, "{}", rms(2));
}

#[test]
fn the_limit_cuts_and_says_so() {
    let mut controller = started(holding(Mode::Pd));
    let output = controller.tick(&[100_000, 0, 0]);
    assert_eq!(output.saturated, [true, false, false]);
    assert!((volts(output.codes)[0] + 9.0).abs() <= VOLTS_PER_LSB);
}

#[test]
fn after_the_end_the_joints_brake_and_hold() {
    let mut block = holding(Mode::Pd);
    block.reference.motion[1] = Motion::Quintic { from_rad: 0.0, to_rad: 1.0, duration_s: 2.0 };
    block.reference.duration_s = 1.0;
    let mut controller = started(block);
    let angles: Vec<f32> = (0..3000)
        .map(|_| controller.tick(&[0; 3]).reference[1].minus(Default::default()))
        .collect();
    // Half way at 15/16 rad/s, then a sixth of a second's travel to rest.
    assert!((angles[1000] - 0.5).abs() < 1e-3, "{}", angles[1000]);
    assert!((angles[2999] - (0.5 + 0.9375 / 6.0)).abs() < 1e-3, "{}", angles[2999]);
    assert_eq!(angles[2999], angles[1501]);
    let steps = angles.windows(2).map(|w| w[1] - w[0]);
    assert!(steps.fold(0.0_f32, |a, b| a.max(b.abs())) < 1e-3, "no jump");
}
