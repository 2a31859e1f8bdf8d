//! Logs of one robot, recorded cold and warm: friction that differs from log to log hides no cause, and is said.

use diagnosis::{Criteria, Diagnosis};
use files::{RobotFile, Role};
use model::reference_robot::reference_robot;
use model::{Friction, Robot};
use recordings::{Campaign, Trace};
use rig::effects::{Catalogue, table_from_text};
use rig::plan::{driven_noise, excitation, slow};
use rig::{Plan, Rig};
use simulation::board::InProcess;
use simulation::friction_law::LuGre;
use simulation::{FrictionLaw, Settings, SimulatedRobot, record_robot, start_of};

const COUNTS_PER_TURN: f64 = 655_360.0;

/// A cogging that takes a twentieth of what the warmth of these logs takes.
const SMALL: [&str; 1] = ["cogging:3:amplitude_V=0.03,harmonic=20,phase_rad=0.7"];

/// Causes that leave many times what warmth does.
const LARGE: [&str; 2] =
    ["payload:0:mass_kg=0.6", "cogging:2:amplitude_V=0.4,harmonic=10,phase_rad=0.7"];

/// What is left of cold friction in each log: the robot warms, and cools before the last.
const WARM: [f64; 4] = [1.0, 0.85, 0.7, 0.8];

fn scaled(friction: &Friction<f64>, factor: f64) -> Box<dyn FrictionLaw> {
    Box::new(LuGre::new(Friction {
        alpha0_v: factor * friction.alpha0_v,
        alpha1_v: factor * friction.alpha1_v,
        alpha2_v_s_per_rad: factor * friction.alpha2_v_s_per_rad,
        ..*friction
    }))
}

fn trace(rig: &Rig, plan: &Plan, seed: u64, factor: f64, hidden: &[&str]) -> Trace {
    let block = plan.block(rig);
    let settings = Settings { seed, ..Settings::default() };
    let catalogue = Catalogue::standard();
    let effect = |text: &&str| catalogue.effect_of(&table_from_text(text).unwrap()).unwrap();
    let effects = hidden.iter().map(effect).collect();
    let truth: Robot<f64> = reference_robot();
    let laws = truth.friction.map(|friction| scaled(&friction, factor));
    let robot = SimulatedRobot::with_effects(truth, effects, start_of(&block), &settings)
        .with_friction_laws(laws);
    let mut board = InProcess::default();
    let recording = record_robot(&mut board, &block, robot, plan.ticks(rig), &mut |_| {}).unwrap();
    Trace::of_log(recording.log, plan.entry("csv"), COUNTS_PER_TURN)
}

/// What logs tell whose friction has these factors, the last of which has this role.
fn diagnosed(factors: [f64; 4], last: Role, hidden: &[&str]) -> Diagnosis {
    let rig = Rig::new(reference_robot());
    let held_out = excitation(5, 10.0).with_role(last);
    let plans = [excitation(3, 12.0), slow(12.0), driven_noise(6.0, 4), held_out];
    let numbered = plans.iter().zip(1..).zip(factors);
    let traces =
        numbered.map(|((plan, seed), factor)| trace(&rig, plan, seed, factor, hidden)).collect();
    let mut file = RobotFile::from_robot(&reference_robot());
    file.robot.encoder_counts_per_rev = Some(COUNTS_PER_TURN);
    file.robot.command_limit_v = Some(10.0);
    file.robot.command_bits = Some(16);
    let campaign = Campaign::new(file, Some(COUNTS_PER_TURN), traces).unwrap();
    let (catalogue, criteria) = (Catalogue::standard(), Criteria::default());
    let found = diagnosis::diagnose(&campaign, &catalogue, &criteria, &|_| ()).unwrap();
    eprintln!("{}", host_tool::commands::diagnose::in_words(&found));
    found
}

fn remark_of_warmth(found: &Diagnosis) -> Option<&String> {
    found.report.remarks.iter().find(|remark| remark.contains("friction differs between"))
}

#[test]
fn a_small_cause_is_named_in_logs_that_are_cold_and_warm() {
    let found = diagnosed(WARM, Role::Holdout, &SMALL);
    let report = &found.report;
    let named: Vec<(&str, u8)> =
        report.causes.iter().map(|cause| (cause.effect.as_str(), cause.joint)).collect();
    assert_eq!(named, [("cogging", 3)]);
    let remark = remark_of_warmth(&found).expect("warmth is said");
    assert!(remark.contains("joint 1 by") && remark.contains("joint 3 by"), "{remark}");
    // What is left of the logs held out is noise, whose friction was in no other log.
    let both = report.gap.with_effects_v.iter().zip(&report.gap.noise_floor_v);
    assert!(both.clone().all(|(left_v, noise_v)| left_v < &(1.6 * noise_v)), "{:?}", report.gap);
}

/// Parts of the logs are held out then, and each is as warm as the part that trains.
#[test]
fn a_small_cause_is_named_where_no_log_is_held_out() {
    let found = diagnosed(WARM, Role::Train, &SMALL);
    let report = &found.report;
    assert!(remark_of_warmth(&found).is_some(), "{:?}", report.remarks);
    assert!(
        report.causes.iter().any(|cause| (cause.effect.as_str(), cause.joint) == ("cogging", 3))
    );
    let both = report.gap.with_effects_v.iter().zip(&report.gap.noise_floor_v);
    assert!(both.clone().all(|(left_v, noise_v)| left_v < &(2.0 * noise_v)), "{:?}", report.gap);
}

/// Friction that is off by the same in all logs is the model's.
#[test]
fn of_logs_that_are_alike_no_warmth_is_said() {
    assert_eq!(remark_of_warmth(&diagnosed([0.85; 4], Role::Holdout, &SMALL)), None);
    let found = diagnosed([1.0; 4], Role::Holdout, &SMALL);
    assert_eq!(remark_of_warmth(&found), None);
    assert_eq!(found.report.causes.len(), 1);
}

/// Beside what they leave warmth does not show, and it is asked for again once they are found.
#[test]
fn warmth_shows_once_the_causes_that_hid_it_are_found() {
    let found = diagnosed(WARM, Role::Holdout, &LARGE);
    let report = &found.report;
    let mut named: Vec<(&str, u8)> =
        report.causes.iter().map(|cause| (cause.effect.as_str(), cause.joint)).collect();
    named.sort_unstable();
    assert_eq!(named, [("cogging", 2), ("payload", 0)]);
    assert!(remark_of_warmth(&found).is_some(), "{:?}", report.remarks);
    let both = report.gap.with_effects_v.iter().zip(&report.gap.noise_floor_v);
    assert!(both.clone().all(|(left_v, noise_v)| left_v < &(2.0 * noise_v)), "{:?}", report.gap);
}
