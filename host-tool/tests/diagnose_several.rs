//! Several causes at once, none of which pays while the others are missing, by a model that is far off.

use diagnosis::{Criteria, Report};
use files::{RobotFile, Role};
use model::reference_robot::reference_robot;
use recordings::{Campaign, Trace};
use rig::effects::{Catalogue, Effect, table_from_text};
use rig::plan::{driven_noise, excitation, slow};
use rig::{Plan, Rig};
use simulation::board::InProcess;
use simulation::{Settings, SimulatedRobot, record_robot, start_of};

const COUNTS_PER_TURN: f64 = 655_360.0;

const HIDDEN: [&str; 4] = [
    "cable_spring:1:stiffness_V_per_rad=0.05,rest_rad=0.5",
    "cable_spring:2:stiffness_V_per_rad=0.11,rest_rad=-2.1",
    "cogging:2:amplitude_V=0.14,harmonic=6,phase_rad=-0.7",
    "torque_constant:3:relative_error=-0.14",
];

fn effects() -> Vec<Box<dyn Effect>> {
    let catalogue = Catalogue::standard();
    let effect = |text: &&str| catalogue.effect_of(&table_from_text(text).unwrap()).unwrap();
    HIDDEN.iter().map(effect).collect()
}

fn trace(rig: &Rig, plan: &Plan, seed: u64) -> Trace {
    let block = plan.block(rig);
    let settings = Settings { seed, ..Settings::default() };
    let robot =
        SimulatedRobot::with_effects(reference_robot(), effects(), start_of(&block), &settings);
    let mut board = InProcess::default();
    let recording = record_robot(&mut board, &block, robot, plan.ticks(rig), &mut |_| {}).unwrap();
    Trace::of_log(recording.log, plan.entry("csv"), COUNTS_PER_TURN)
}

/// The reference robot's file with base parameters up to 14 % off, some up, some down.
fn far_off() -> RobotFile {
    let mut robot = reference_robot();
    let off = |k: usize| 1.0 + 0.14 * (2.4 * k as f64).sin();
    let mut values = robot.base.to_array();
    values.iter_mut().enumerate().for_each(|(k, value)| *value *= off(k));
    robot.base = model::BaseParameters::from_array(values);
    let mut file = RobotFile::from_robot(&robot);
    file.robot.encoder_counts_per_rev = Some(COUNTS_PER_TURN);
    file.robot.command_limit_v = Some(10.0);
    file.robot.command_bits = Some(16);
    file
}

fn diagnosed() -> Report {
    let rig = Rig::new(reference_robot());
    let held_out = excitation(5, 10.0).with_role(Role::Holdout);
    let plans = [excitation(3, 24.0), slow(24.0), driven_noise(6.0, 4), held_out];
    let traces = plans.iter().zip(1..).map(|(plan, seed)| trace(&rig, plan, seed)).collect();
    let campaign = Campaign::new(far_off(), Some(COUNTS_PER_TURN), traces).unwrap();
    let (catalogue, criteria) = (Catalogue::standard(), Criteria::default());
    let found = diagnosis::diagnose(&campaign, &catalogue, &criteria, &|_| ()).unwrap();
    eprintln!("{}", host_tool::commands::diagnose::in_words(&found));
    found.report
}

#[test]
fn what_hides_each_other_is_named_together() {
    let report = diagnosed();
    let mut named: Vec<(&str, u8)> =
        report.causes.iter().map(|cause| (&cause.effect[..], cause.joint)).collect();
    named.sort_unstable();
    let hidden = [("cable_spring", 1), ("cable_spring", 2), ("cogging", 2), ("torque_constant", 3)];
    assert_eq!(named, hidden);
}
