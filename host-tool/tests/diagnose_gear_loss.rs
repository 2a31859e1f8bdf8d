//! An arm whose gears take a part of their motors' torque, which its model does not tell: no cause, and it must not
//! bend the load.

mod arms;

use arms::recorded;
use diagnosis::{Criteria, Report, Value};
use files::example_arms::six_axes;
use rig::Plant;
use rig::effects::Catalogue;

/// Part of every motor's torque that its gear takes.
const LOSS: f64 = 0.06;

/// What an arm of six joints is told whose gears take that part, and that has something else.
fn with_lossy_gears(others: &[&str]) -> Report {
    let arm = six_axes();
    let constants = Plant::of_arm(&arm).unwrap().torque_constant_nm_per_v;
    let of_joint = |(index, k_t): (usize, &f64)| {
        let coefficient = LOSS / k_t;
        format!("load_friction:{}:coefficient_V_per_Nm={coefficient},by_motor_torque=1", index + 1)
    };
    let gears: Vec<String> = constants.iter().enumerate().map(of_joint).collect();
    let hidden: Vec<&str> =
        gears.iter().map(String::as_str).chain(others.iter().copied()).collect();
    let campaign = recorded(&arm, 125.0, 12.0, &hidden);
    let catalogue = Catalogue::of_arm(arm.joints.len());
    let found =
        diagnosis::diagnose_arm(&campaign, &catalogue, &Criteria::default(), &|_| ()).unwrap();
    eprintln!("{}", host_tool::commands::diagnose::in_words(&found));
    found.report
}

/// The loss that the report tells.
fn loss(report: &Report) -> f64 {
    let mut changed = report.parameters_changed.iter();
    changed.find(|change| change.parameter == "gears.loss").expect("the loss is told").found
}

#[test]
fn a_loss_that_is_the_same_in_all_gears_is_no_cause() {
    let report = with_lossy_gears(&[]);
    assert!(report.causes.is_empty(), "{:?}", report.causes);
    assert!((loss(&report) / LOSS - 1.0).abs() < 0.1, "{}", loss(&report));
}

#[test]
fn a_load_beside_gears_that_take_a_part_of_the_torque_is_told() {
    let report = with_lossy_gears(&["payload:mass_kg=0.5,com_m=0.05 0 0.1"]);
    let [cause] = &report.causes[..] else { panic!("{:?}", report.causes) };
    assert_eq!(cause.effect, "payload");
    let Value::Number(mass_kg) = cause.parameters["mass_kg"] else { panic!("a mass") };
    assert!((mass_kg / 0.5 - 1.0).abs() < 0.05, "{mass_kg}");
    assert!((loss(&report) / LOSS - 1.0).abs() < 0.1, "{}", loss(&report));
}
