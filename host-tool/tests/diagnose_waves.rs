//! Waves over the turn: orders that are no whole numbers, and ripple of a command that holds an arm against gravity.

use diagnosis::{Cause, Criteria, Value};
use files::{RobotFile, Role};
use model::reference_robot::reference_robot;
use recordings::{Campaign, Trace};
use rig::effects::{Catalogue, table_from_text};
use rig::plan::{driven_noise, excitation, slow};
use rig::{Plan, Rig};
use simulation::board::InProcess;
use simulation::{Settings, SimulatedRobot, record_robot, start_of};

const COUNTS_PER_TURN: f64 = 655_360.0;

fn trace(rig: &Rig, plan: &Plan, hidden: &str, seed: u64) -> Trace {
    let block = plan.block(rig);
    let settings = Settings { seed, ..Settings::default() };
    let effect = Catalogue::standard().effect_of(&table_from_text(hidden).unwrap()).unwrap();
    let start = start_of(&block);
    let robot = SimulatedRobot::with_effects(reference_robot(), vec![effect], start, &settings);
    let mut board = InProcess::default();
    let recording = record_robot(&mut board, &block, robot, plan.ticks(rig), &mut |_| {}).unwrap();
    Trace::of_log(recording.log, plan.entry("csv"), COUNTS_PER_TURN)
}

/// The one cause that is found of a robot with this hidden.
fn cause_of(hidden: &str) -> Cause {
    let rig = Rig::new(reference_robot());
    let held_out = excitation(5, 8.0).with_role(Role::Holdout);
    let plans = [excitation(3, 12.0), slow(12.0), driven_noise(4.0, 4), held_out];
    let logs = plans.iter().zip(1..).map(|(plan, seed)| trace(&rig, plan, hidden, seed));
    let mut model = RobotFile::from_robot(&reference_robot());
    model.robot.encoder_counts_per_rev = Some(COUNTS_PER_TURN);
    let campaign = Campaign::new(model, Some(COUNTS_PER_TURN), logs.collect()).unwrap();
    let (catalogue, criteria) = (Catalogue::standard(), Criteria::default());
    let found = diagnosis::diagnose(&campaign, &catalogue, &criteria, &|_| ()).unwrap();
    eprintln!("{}", diagnosis::sentence(&found));
    let [cause] = &found.report.causes[..] else { panic!("{:?}", found.report.causes) };
    cause.clone()
}

fn number(cause: &Cause, name: &str) -> f64 {
    match cause.parameters[name] {
        Value::Number(number) => number,
        _ => panic!("{name} is no number"),
    }
}

#[test]
fn a_wave_whose_order_is_no_whole_number_is_named_with_its_order() {
    let cause = cause_of("cogging:2:amplitude_V=0.08,harmonic=4.45,phase_rad=1.2");
    assert_eq!((cause.effect.as_str(), cause.joint), ("cogging", 2));
    assert!((number(&cause, "harmonic") - 4.45).abs() < 0.02, "{cause:?}");
    assert!((number(&cause, "amplitude_V") - 0.08).abs() < 0.004, "{cause:?}");
}

#[test]
fn small_ripple_of_a_command_against_gravity_is_not_told_as_cogging() {
    let cause = cause_of("torque_ripple:2:relative_amplitude=0.012,harmonic=3,phase_rad=0.3");
    assert_eq!((cause.effect.as_str(), cause.joint), ("torque_ripple", 2));
    assert!((number(&cause, "harmonic") - 3.0).abs() < 1e-9, "{cause:?}");
}
