//! Torque constants are told against each other only: one is named where all of them open tell it.

use diagnosis::{Criteria, Diagnosis, Interval, Value};
use files::{RobotFile, Role};
use model::Robot;
use model::reference_robot::reference_robot;
use recordings::{Campaign, Trace};
use rig::effects::Catalogue;
use rig::plan::{driven_noise, excitation, slow};
use rig::{Plan, Rig};
use simulation::board::InProcess;
use simulation::{Settings, SimulatedRobot, record_robot, start_of};

const COUNTS_PER_TURN: f64 = 655_360.0;

/// The robot whose torque constants are off by these parts, and whose masses and friction are by some per cent.
fn robot_off_by(constants: [f64; 3]) -> Robot<f64> {
    let mut robot = reference_robot();
    for (k_t, off) in robot.torque_constant_nm_per_v.iter_mut().zip(constants) {
        *k_t *= 1.0 + off;
    }
    let mut base = robot.base.to_array();
    for (value, off) in base.iter_mut().zip([0.03, -0.05, 0.04, -0.02, 0.06].iter().cycle()) {
        *value *= 1.0 + off;
    }
    robot.base = model::BaseParameters::from_array(base);
    robot
}

fn trace(rig: &Rig, plan: &Plan, seed: u64, truth: Robot<f64>) -> Trace {
    let block = plan.block(rig);
    let settings = Settings { seed, ..Settings::default() };
    let robot = SimulatedRobot::with_effects(truth, Vec::new(), start_of(&block), &settings);
    let mut board = InProcess::default();
    let recording = record_robot(&mut board, &block, robot, plan.ticks(rig), &mut |_| {}).unwrap();
    Trace::of_log(recording.log, plan.entry("csv"), COUNTS_PER_TURN)
}

fn diagnosed(constants: [f64; 3]) -> Diagnosis {
    let rig = Rig::new(reference_robot());
    let held_out = excitation(5, 10.0).with_role(Role::Holdout);
    let plans = [excitation(3, 12.0), slow(12.0), driven_noise(6.0, 4), held_out];
    let truth = robot_off_by(constants);
    let traces = plans.iter().zip(1..).map(|(plan, seed)| trace(&rig, plan, seed, truth)).collect();
    let mut file = RobotFile::from_robot(&reference_robot());
    file.robot.encoder_counts_per_rev = Some(COUNTS_PER_TURN);
    file.robot.command_limit_v = Some(10.0);
    file.robot.command_bits = Some(16);
    let campaign = Campaign::new(file, Some(COUNTS_PER_TURN), traces).unwrap();
    let mut criteria = Criteria::default();
    (criteria.prior.relative, criteria.prior.relative_friction) = (0.06, 0.06);
    diagnosis::diagnose(&campaign, &Catalogue::standard(), &criteria, &|_| ()).unwrap()
}

/// What is named, each a torque constant: its joint, by how much it is off, and the interval of that.
fn named(found: &Diagnosis) -> Vec<(u8, f64, [f64; 2])> {
    let constant = |cause: &diagnosis::Cause| {
        assert_eq!(cause.effect, "torque_constant");
        match (&cause.parameters["relative_error"], &cause.parameter_intervals["relative_error"]) {
            (Value::Number(off), Interval::Number(interval)) => (cause.joint, *off, *interval),
            other => panic!("{other:?}"),
        }
    };
    found.report.causes.iter().map(constant).collect()
}

fn remark(found: &Diagnosis) -> Option<&String> {
    found.report.remarks.iter().find(|remark| remark.contains("told against each other"))
}

#[test]
fn one_that_is_off_alone_is_named() {
    let found = diagnosed([0.0, -0.12, 0.0]);
    let named = named(&found);
    assert_eq!(named.len(), 1, "{named:?}");
    let (joint, off, [from, to]) = named[0];
    assert_eq!(joint, 2);
    assert!(from < -0.12 && -0.12 < to && (off + 0.12).abs() < 0.03, "{named:?}");
    assert_eq!(remark(&found), None);
}

/// The fewest that do the same are other ones, and off by more: intervals hold what is true.
#[test]
fn where_all_are_off_intervals_hold_what_others_may_take() {
    let constants = [-0.040, 0.039, -0.029];
    let found = diagnosed(constants);
    let named = named(&found);
    assert!(named.iter().any(|(joint, ..)| *joint == 2), "{named:?}");
    for (joint, off, [from, to]) in named.iter().copied() {
        let truth = constants[usize::from(joint) - 1];
        assert!(off * truth > 0.0 && from < truth && truth < to, "{named:?}");
    }
}

/// By how much they differ is told well, and which of them is off is not: they are in doubt, and in the amended model.
#[test]
fn where_they_differ_by_less_than_their_doubt_none_is_named() {
    let found = diagnosed([0.015, -0.015, 0.0]);
    assert_eq!(named(&found), []);
    let remark = remark(&found).expect("what is in doubt is said");
    assert!((1..=3).all(|joint| remark.contains(&format!("joint {joint} by"))), "{remark}");
    let amended = found.model.to_toml().unwrap();
    assert_eq!(amended.matches("\"torque_constant\"").count(), 3, "{amended}");
    assert_eq!(found.report.verdict, diagnosis::Verdict::None);
    let gap = &found.report.gap;
    let both = gap.with_effects_v.iter().zip(&gap.noise_floor_v);
    assert!(both.clone().all(|(left_v, noise_v)| left_v < &(1.6 * noise_v)), "{gap:?}");
    let untestable = found.report.untestable.iter().filter(|it| it.effect == "torque_constant");
    assert_eq!(untestable.count(), 3);
}
