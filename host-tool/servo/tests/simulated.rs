//! Simulated servo arms: what is hidden in them is found, and nothing where nothing is.

use diagnosis::{Report, Value, Verdict};
use servo::prepared::joints;
use servo::recorded::{Recording, Truth, record};
use servo::report::report;
use servo::synthetic::{links_of, pendulum, six_axes};
use servo::{Outcome, ServoJoint, Settings, prepared};

fn short() -> Recording {
    Recording { length_s: 24.0, logs: [5, 3], ..Recording::default() }
}

fn diagnosed(campaign: &recordings::ArmCampaign) -> (Outcome, Report) {
    let outcome = Outcome::of(campaign, &Settings::default(), &|_| ()).unwrap();
    let report = report(&outcome);
    (outcome, report)
}

/// The mass that a report names [kg].
fn named_mass(report: &Report) -> Option<f64> {
    let payload = report.causes.iter().find(|cause| cause.effect == "payload")?;
    match payload.parameters["mass_kg"] {
        Value::Number(mass) => Some(mass),
        Value::Vector(_) => None,
    }
}

/// A model of one mass, logs of another.
fn exchanged(seed: u64, added_kg: f64) -> recordings::ArmCampaign {
    let truth = pendulum(seed, 0.4 + added_kg, 0.15);
    let recording = Recording { swing_rad: 1.5, ..short() };
    let servos = prepared::joints(&truth).unwrap();
    let mut campaign = record(&truth, &Truth::of(links_of(&truth), servos), &recording, seed);
    campaign.arm = pendulum(seed, 0.4, 0.15);
    campaign
}

#[test]
fn an_exchanged_mass_is_named_within_a_tenth() {
    for (seed, added_kg) in [(11, 0.2), (12, -0.15), (13, 0.35)] {
        let (_, report) = diagnosed(&exchanged(seed, added_kg));
        let mass = named_mass(&report).expect("a payload");
        assert!((mass - added_kg).abs() < 0.1 * added_kg.abs(), "{mass} for {added_kg}");
        assert_eq!(report.causes.len(), 1, "{:?}", report.causes);
    }
}

#[test]
fn an_arm_with_nothing_hidden_has_no_gap() {
    let file = six_axes(21);
    let servos = prepared::joints(&file).unwrap();
    let (_, report) = diagnosed(&record(&file, &Truth::of(links_of(&file), servos), &short(), 21));
    assert_eq!(report.verdict, Verdict::None, "{:?} {:?}", report.causes, report.gap);
}

#[test]
fn the_amended_model_moves_as_the_arm_does() {
    let file = six_axes(31);
    let mut servos = prepared::joints(&file).unwrap();
    servos[2] = ServoJoint { limit: 1.4, ..servos[2] };
    let campaign = record(&file, &Truth::of(links_of(&file), servos), &short(), 31);
    let (outcome, report) = diagnosed(&campaign);
    let cause = &report.causes[0];
    assert_eq!((cause.effect.as_str(), cause.joint), ("saturation", 3), "{:?}", report.causes);
    assert!(matches!(cause.parameters["limit_V"], Value::Number(v) if (v - 1.4).abs() < 0.3));
    let mut amended = campaign.clone();
    amended.arm = servo::model_file::model_file(&outcome);
    let identified = servo::Identified::of(&amended, &Settings::default()).unwrap();
    let joint = &identified.summary.joints[2];
    let (before, after) = (report.gap.refitted_rad[2], joint.as_given_rad);
    assert!(after < 0.7 * before, "{before} {after}");
}

/// Causes of an arm of six servos, of which the first joint is another than in the model.
fn causes_of(first: impl Fn(ServoJoint) -> ServoJoint) -> Vec<(String, u8)> {
    let file = six_axes(41);
    let mut servos = prepared::joints(&file).unwrap();
    servos[0] = first(servos[0]);
    let (_, report) = diagnosed(&record(&file, &Truth::of(links_of(&file), servos), &short(), 41));
    report.causes.iter().map(|cause| (cause.effect.clone(), cause.joint)).collect()
}

#[test]
fn asymmetry_of_viscous_friction_is_told_from_that_of_all_friction() {
    let named = causes_of(|joint| ServoJoint { viscous_asymmetry: 0.3, ..joint });
    assert_eq!(named, [("viscous_asymmetry".into(), 1)]);
    let named = causes_of(|joint| ServoJoint { asymmetry: 0.3, ..joint });
    assert_eq!(named, [("asymmetric_friction".into(), 1)]);
}

#[test]
fn an_offset_is_told_from_the_spring_that_rests_far_away() {
    let named = causes_of(|joint| ServoJoint { offset: 0.2, ..joint });
    assert_eq!(named, [("dac_offset".into(), 1)]);
}

#[test]
fn another_seed_draws_other_motions_and_another_arm() {
    let file = pendulum(2, 0.35, 0.16);
    let truth = Truth::of(links_of(&file), joints(&file).unwrap());
    let recording = Recording { length_s: 5.0, logs: [1, 1], ..Recording::default() };
    let goals = |seed| {
        let campaign = record(&file, &truth, &recording, seed);
        campaign.recordings[0].log.joints[0].command.clone()
    };
    assert_ne!(goals(2), goals(3));
    assert_ne!(file, pendulum(3, 0.35, 0.16));
}
