//! The effect of compensations in each mode.
#![allow(missing_docs)]

mod common;

use common::{block, joint};
use firmware::compensation::{
    AngularHarmonic, Compensations, ExternalLoad, Feedforward, InputInverse, Table, TableAxis,
};
use firmware::dac::VOLTS_PER_LSB;
use firmware::reference::Reference;
use firmware::{Angle, Controller, DacCode, Mode, ParameterBlock};
use model::effects::Tilt;

const WAVE: AngularHarmonic = AngularHarmonic { order: 8, phase: Angle(1 << 28) };
const COGGING: Feedforward = Feedforward::Cogging { amplitude_v: 0.2, wave: WAVE };
const OFFSET: InputInverse = InputInverse::DacOffset { offset_v: 0.3 };

/// Holds at an angle of all joints, where gravity and friction ask for what they ask.
fn holding(mode: Mode, angle_rad: f32, third: Compensations) -> ParameterBlock {
    let compensations = [Compensations::default(), Compensations::default(), third];
    ParameterBlock { reference: Reference::hold([angle_rad; 3]), compensations, ..block(mode) }
}

/// What joint 3 is told at first, 1 mrad away from where it shall be [V].
fn first_voltage(block: ParameterBlock) -> f32 {
    block.check().unwrap();
    let mut controller = Controller::new(block);
    controller.start();
    DacCode::to_volts(controller.tick(&[0, 0, 104]).codes[2])
}

/// What compensations change of the first voltage [V].
fn change(mode: Mode, angle_rad: f32, third: &Compensations) -> f32 {
    let without = first_voltage(holding(mode, angle_rad, Compensations::default()));
    first_voltage(holding(mode, angle_rad, third.clone())) - without
}

fn assert_near(found: f32, expected: f32) {
    assert!((found - expected).abs() <= VOLTS_PER_LSB, "{found} {expected}");
}

#[test]
fn what_the_motor_finds_added_is_taken_off_where_the_model_is_known() {
    let cogging = joint(&[COGGING], &[]);
    let expected = -0.2 * (8.0 * 0.001_f32 + std::f32::consts::TAU / 16.0).sin();
    assert_near(change(Mode::PdModel, 0.001, &cogging), expected);
    for mode in [Mode::Pd, Mode::PdFriction, Mode::FrictionOnly, Mode::OpenLoop] {
        assert_eq!(change(mode, 0.001, &cogging), 0.0, "{}", mode.name());
    }
}

#[test]
fn the_command_is_corrected_where_there_is_feedforward() {
    let offset = joint(&[], &[OFFSET]);
    for mode in [Mode::PdModel, Mode::PdFriction] {
        assert_near(change(mode, 0.0, &offset), -0.3);
    }
    for mode in [Mode::Pd, Mode::FrictionOnly, Mode::OpenLoop] {
        assert_eq!(change(mode, 0.0, &offset), 0.0, "{}", mode.name());
    }
}

#[test]
fn what_befell_the_command_last_is_undone_first() {
    let constant = InputInverse::TorqueConstant { relative_error: -0.5 };
    let wanted = first_voltage(holding(Mode::PdModel, 0.0, Compensations::default()));
    assert_near(change(Mode::PdModel, 0.0, &joint(&[], &[OFFSET, constant])), wanted - 0.3);
    assert_near(change(Mode::PdModel, 0.0, &joint(&[], &[constant, OFFSET])), wanted - 0.6);
}

#[test]
fn a_cable_knows_the_turn() {
    let spring = |rest_rad| Feedforward::CableSpring { stiffness_v_per_rad: 0.1, rest_rad };
    for rest_rad in [-9.0, 0.0, 9.0] {
        assert_near(change(Mode::PdModel, 1e-3, &joint(&[spring(rest_rad)], &[])), -0.1 * rest_rad);
    }
}

#[test]
fn friction_alone_is_scaled_where_the_joint_is() {
    let varied = Feedforward::PositionFriction {
        relative_amplitude: 0.5,
        wave: AngularHarmonic { order: 1, phase: Angle(0) },
    };
    // A hundred slow ticks, a quarter turn away from the reference.
    let voltage = |third| {
        let mut controller = Controller::new(holding(Mode::FrictionOnly, 0.0, third));
        controller.start();
        let ticks = (0..300).map(|k| controller.tick(&[0, 0, 655_360 / 4 + 10 * k]));
        DacCode::to_volts(ticks.last().unwrap().codes[2])
    };
    let (plain, scaled) = (voltage(Compensations::default()), voltage(joint(&[varied], &[])));
    let level = plain - 0.1252 * 0.0959;
    assert!((scaled - plain - 0.5 * level).abs() < 0.01 * level, "{plain} {scaled}");
}

#[test]
fn torques_from_outside_are_held() {
    let mut block = holding(Mode::PdModel, 0.0, Compensations::default());
    let without = first_voltage(block.clone());
    let tilt = Tilt { gravity_change: [0.0, 0.0, 0.01], ..Tilt::default() };
    block.external_load = Some(ExternalLoad { tip_force_n: [0.0, 0.0, 2.0], tilt });
    let robot = block.robot;
    let weight_nm = 0.01 * 9.81 * robot.base.mx3r;
    assert_near(first_voltage(block) - without, -(2.0 * 0.415 + weight_nm) / 3.0);
}

/// Joint 3 with a table that adds 0.5 V at `x` and falls off to both sides.
fn peak_at(axis: TableAxis, x: f32) -> Compensations {
    let table = Table {
        axis,
        knots: [x - 1.0, x, x + 1.0].into_iter().collect(),
        values_v: [0.0, 0.5, 0.0].into_iter().collect(),
    };
    Compensations { tables: [table].into_iter().collect(), ..Compensations::default() }
}

#[test]
fn a_table_is_taken_off_at_the_reference_where_the_model_is_known() {
    let gravity_nm = {
        let robot = block(Mode::PdModel).robot;
        model::Posture::new(0.001, 0.001).gravity(&robot.base, &robot.geometry)[2]
    };
    for (axis, x) in
        [(TableAxis::Position, 0.001), (TableAxis::Velocity, 0.0), (TableAxis::Load, gravity_nm)]
    {
        assert_near(change(Mode::PdModel, 0.001, &peak_at(axis, x)), -0.5);
        assert_near(change(Mode::PdModel, 0.001, &peak_at(axis, x + 0.5)), -0.25);
        assert_near(change(Mode::PdModel, 0.001, &peak_at(axis, x - 2.0)), 0.0);
        for mode in [Mode::Pd, Mode::PdFriction, Mode::FrictionOnly, Mode::OpenLoop] {
            assert_eq!(change(mode, 0.001, &peak_at(axis, x)), 0.0, "{}", mode.name());
        }
    }
}
