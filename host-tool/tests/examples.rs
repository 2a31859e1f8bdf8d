//! The examples do what they promise.
#![allow(missing_docs)]

use std::path::Path;

use files::{Dataset, Role};
use model::reference_robot::reference_robot;
use rig::{Plan, Rig, plan};
use simulation::board::InProcess;
use simulation::{Settings, SimulatedRobot, record_robot, start_of};

#[path = "../examples/diagnose.rs"]
mod diagnose;
#[path = "../examples/inverse_dynamics.rs"]
mod inverse_dynamics;
#[path = "../examples/talk_to_board.rs"]
mod talk_to_board;

mod common;
use common::with_model;

#[test]
fn inverse_dynamics_gives_torques_and_the_voltages_for_them() {
    let directory = with_model();
    let model = directory.path().join("model.toml");
    let [torque_nm, voltage_v] = inverse_dynamics::torques_and_voltages(&model).unwrap();
    assert!(torque_nm.iter().all(|torque| torque.abs() > 1e-3), "{torque_nm:?}");
    assert_eq!(voltage_v, reference_robot().torque_to_voltage(&torque_nm));
}

#[test]
fn a_simulated_board_is_talked_to() {
    let text = talk_to_board::of_simulated_board().unwrap();
    assert!(text.starts_with("simulated, build ") && text.ends_with(": disarmed"), "{text}");
}

/// Records a plan on a robot with an offset at an output, and writes the log.
fn record(plan: &Plan, directory: &Path) {
    let rig = Rig::new(reference_robot());
    let (settings, block) = (Settings::default(), plan.block(&rig));
    let table = rig::effects::table_from_text("dac_offset:1:offset_V=0.2").unwrap();
    let effects = vec![rig::effects::Catalogue::standard().effect_of(&table).unwrap()];
    let robot = SimulatedRobot::with_effects(rig.model, effects, start_of(&block), &settings);
    let mut board = InProcess::default();
    let ticks = plan.ticks(&rig);
    let recording = record_robot(&mut board, &block, robot, ticks, &mut |_| {}).unwrap();
    recording.log.write(directory.join(plan.entry("csv").file)).unwrap();
}

#[test]
fn a_folder_is_diagnosed_in_a_sentence() {
    let directory = with_model();
    let held_out = plan::excitation(2, 4.0).with_role(Role::Holdout);
    let plans = [plan::excitation(1, 8.0), plan::slow(6.0), held_out];
    plans.iter().for_each(|plan| record(plan, directory.path()));
    let dataset = Dataset {
        directory: directory.path().to_owned(),
        encoder_counts_per_rev: Some(655_360.0),
        entries: plans.iter().map(|plan| plan.entry("csv")).collect(),
    };
    dataset.write(directory.path()).unwrap();
    let sentence = diagnose::diagnosed(directory.path()).unwrap();
    assert!(sentence.starts_with("Joint 1: dac offset, 0.2 V"), "{sentence}");
}
